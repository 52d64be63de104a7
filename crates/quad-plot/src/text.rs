//! Rich text for labels, legends, diagrams and the gallery.
//!
//! `*z*` is italic, `_{ref}` or `_r` a subscript, `^{2}` or `^2` a superscript; a backslash before `*`, `_`, `^` or
//! itself takes the sign as it is. Symbols are Unicode: `θ̇` (theta and a combining dot), `ż`, `ω`, `·`, `−`.

use std::fmt::Write;

use super::xml::{escape, number};

/// A run of characters in one style.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Span {
    /// The characters.
    pub text: String,
    /// Whether they are italic.
    pub italic: bool,
    /// Where they stand relative to the base line.
    pub shift: Shift,
}

/// Position of a [`Span`] relative to the base line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shift {
    /// On the base line.
    None,
    /// Subscript.
    Sub,
    /// Superscript.
    Super,
}

/// Size of sub- and superscripts relative to the text.
const SCRIPT_SIZE: f64 = 0.72;
/// Depth of a subscript below the base line, in font sizes.
const SUB_DEPTH: f64 = 0.22;
/// Height of a superscript above the base line, in font sizes.
const SUPER_HEIGHT: f64 = 0.36;

/// Splits rich text into spans.
pub fn spans(source: &str) -> Vec<Span> {
    let mut spans: Vec<Span> = Vec::new();
    let (mut italic, mut shift, mut group) = (false, Shift::None, false);
    let mut characters = source.chars().peekable();
    while let Some(c) = characters.next() {
        match c {
            '\\' => push(&mut spans, characters.next().unwrap_or('\\'), italic, shift),
            '*' => italic = !italic,
            '_' | '^' if shift == Shift::None => {
                shift = if c == '_' { Shift::Sub } else { Shift::Super };
                group = characters.next_if_eq(&'{').is_some();
            }
            '}' if group => (shift, group) = (Shift::None, false),
            _ => {
                push(&mut spans, c, italic, shift);
                // A combining mark belongs to the character before it.
                let marked = characters.peek().is_some_and(|next| is_combining(*next));
                if !group && !marked {
                    shift = Shift::None;
                }
            }
        }
    }
    spans
}

fn is_combining(c: char) -> bool {
    ('\u{300}'..='\u{36f}').contains(&c)
}

fn push(spans: &mut Vec<Span>, c: char, italic: bool, shift: Shift) {
    match spans.last_mut() {
        Some(last) if last.italic == italic && last.shift == shift => last.text.push(c),
        _ => spans.push(Span {
            text: c.to_string(),
            italic,
            shift,
        }),
    }
}

/// The text without any style.
pub fn plain(source: &str) -> String {
    spans(source).into_iter().map(|span| span.text).collect()
}

/// The text as HTML.
pub fn html(source: &str) -> String {
    let mut out = String::new();
    for span in spans(source) {
        let (mut before, mut after) = match span.shift {
            Shift::None => (String::new(), String::new()),
            Shift::Sub => ("<sub>".into(), "</sub>".into()),
            Shift::Super => ("<sup>".into(), "</sup>".into()),
        };
        if span.italic {
            before.push_str("<i>");
            after.insert_str(0, "</i>");
        }
        out += &format!("{before}{}{after}", escape(&span.text));
    }
    out
}

/// The text as the content of an SVG `text` element of this font size, in `tspan`s.
pub fn tspans(source: &str, size: f64) -> String {
    let mut out = String::new();
    let mut depth = 0.0;
    for span in spans(source) {
        let (target, scale) = match span.shift {
            Shift::None => (0.0, 1.0),
            Shift::Sub => (SUB_DEPTH * size, SCRIPT_SIZE),
            Shift::Super => (-SUPER_HEIGHT * size, SCRIPT_SIZE),
        };
        let mut attributes = String::new();
        if target != depth {
            let _ = write!(attributes, " dy=\"{}\"", number(target - depth));
        }
        if scale != 1.0 {
            let _ = write!(attributes, " font-size=\"{}\"", number(scale * size));
        }
        if span.italic {
            attributes += " font-style=\"italic\"";
        }
        depth = target;
        let text = escape(&span.text);
        if attributes.is_empty() {
            out += &text;
        } else {
            let _ = write!(out, "<tspan{attributes}>{text}</tspan>");
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_markup() {
        assert_eq!(
            html("Height *z*_{ref}, m^2"),
            "Height <i>z</i><sub>ref</sub>, m<sup>2</sup>"
        );
        assert_eq!(html("*θ̇*_x a\\_b"), "<i>θ̇</i><sub>x</sub> a_b");
        assert_eq!(plain("*e*_{z} < 1"), "ez < 1");
    }

    #[test]
    fn exact_baseline_returns_after_a_subscript() {
        let text = tspans("a_{1}b", 10.0);
        assert_eq!(
            text,
            "a<tspan dy=\"2.2\" font-size=\"7.2\">1</tspan><tspan dy=\"-2.2\">b</tspan>"
        );
    }
}
