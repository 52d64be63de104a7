//! Numbers and words as XML may hold them.

/// Coordinates farther out than this, px, are drawn here: no picture is as large, and renderers compute in single precision.
const FARTHEST_PX: f64 = 1e6;

/// A coordinate with at most two decimals. A number that is not finite is written as a finite one, so that a document stays valid.
pub fn number(value: f64) -> String {
    let value = if value.is_nan() { 0.0 } else { value };
    let rounded = (value.clamp(-FARTHEST_PX, FARTHEST_PX) * 100.0).round() / 100.0;
    // Adding zero turns −0 into 0.
    format!("{}", rounded + 0.0)
}

/// Text made safe for SVG and HTML: signs of the markup as entities, and a replacement character for what XML can't hold.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\t' | '\n' | '\r' => out.push(c),
            '\0'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => out.push(char::REPLACEMENT_CHARACTER),
            _ => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_numbers_are_short() {
        assert_eq!(number(1.0), "1");
        assert_eq!(number(-0.001), "0");
        assert_eq!(number(2.345_6), "2.35");
        assert_eq!(
            [f64::NAN, f64::INFINITY, -1e308].map(number),
            ["0", "1000000", "-1000000"]
        );
    }

    #[test]
    fn exact_text_that_xml_cannot_hold_is_replaced() {
        assert_eq!(escape("a<b>&\"\u{1}\n"), "a&lt;b&gt;&amp;&quot;\u{fffd}\n");
    }
}
