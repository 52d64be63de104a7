//! Text from files, made safe and short enough to print.
//!
//! A terminal obeys control characters (it clears its screen, changes its title, answers as if somebody typed), and characters that
//! reverse the direction of writing make a text look like another.

use std::borrow::Cow;
use std::fmt::Write as _;

/// Longest word, in characters, that a message shows in full: no name of ours and no usual path is longer.
const LONGEST_WORD: usize = 300;

/// Characters that are left of a longer one.
const SHOWN: usize = 60;

/// Characters of a message.
const LONGEST_MESSAGE: usize = 8000;

/// Digits from which on a number is written with an exponent; no f64 needs more than 17.
const LONGEST_NUMBER: usize = 25;

/// Whether a character does something to a terminal, the direction of the text, or the validity of XML.
fn acts(c: char) -> bool {
    c.is_control()
        || matches!(c,
            // Line and paragraph separators; the byte-order mark.
            '\u{2028}' | '\u{2029}' | '\u{feff}'
            // Unicode Standard Annex 9, table 4: marks, embeddings, overrides, isolates.
            | '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
            // No characters of XML.
            | '\u{fffe}' | '\u{ffff}')
}

/// Whether a text can be printed as it is, in one line: no control characters, no characters that change the direction of writing.
pub fn is_printable(text: &str) -> bool {
    !text.chars().any(acts)
}

/// A text with the characters that a terminal obeys written out, as in `\u001b`, but for ends of lines and tabulators. JSON reads the same text
/// from both.
pub fn escaped(text: &str) -> Cow<'_, str> {
    let plain = |c: char| matches!(c, '\n' | '\t') || !acts(c);
    if text.chars().all(plain) {
        return Cow::Borrowed(text);
    }
    let mut escaped = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if plain(c) {
            escaped.push(c);
        } else {
            // All of them are below U+10000.
            let _ = write!(escaped, "\\u{:04x}", u32::from(c));
        }
    }
    Cow::Owned(escaped)
}

/// The beginning of a long word or number, with its length; a short one as it is.
pub fn shortened(word: &str) -> Cow<'_, str> {
    if word.len() > LONGEST_NUMBER
        && word
            .bytes()
            .all(|b| b.is_ascii_digit() || matches!(b, b'.' | b'-' | b'+'))
        && let Ok(number) = word.parse::<f64>()
    {
        return Cow::Owned(format!("{number:e}"));
    }
    let length = word.chars().count();
    if length <= LONGEST_WORD {
        return Cow::Borrowed(word);
    }
    let shown: String = word.chars().take(SHOWN).collect();
    Cow::Owned(format!("{shown}… ({length} characters)"))
}

/// A message for a terminal: [`escaped`], every long word or number [`shortened`], and no longer than a screen or two.
pub fn message(text: &str) -> String {
    let text = escaped(text);
    if let Some((end, _)) = text.char_indices().nth(LONGEST_MESSAGE) {
        return words(&text[..end]) + "… (shortened)";
    }
    words(&text)
}

fn words(text: &str) -> String {
    let mut message = String::with_capacity(text.len());
    for piece in text
        .split_inclusive(|c: char| c.is_whitespace() || matches!(c, ',' | '[' | ']' | '(' | ')' | '"' | '`'))
    {
        let end = piece.chars().next_back().filter(|c| !c.is_alphanumeric());
        let word = end.map_or(piece, |end| &piece[..piece.len() - end.len_utf8()]);
        message += &shortened(word);
        message += &piece[word.len()..];
    }
    message
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn exact_what_a_terminal_obeys_is_written_out() {
        assert_eq!(escaped("a\u{1b}[2Jb"), "a\\u001b[2Jb");
        assert_eq!(
            escaped("\u{9b}2J\u{7f}\u{202e}x\r"),
            "\\u009b2J\\u007f\\u202ex\\u000d"
        );
        assert_eq!(escaped("öäü 漢\n\t"), "öäü 漢\n\t");
        assert!(!is_printable("a\nb") && !is_printable("\u{2066}") && is_printable("Größe 漢 'x'"));
    }

    #[test]
    fn exact_numbers_and_names_are_short() {
        assert_eq!(shortened(&format!("1{}", "0".repeat(308))), "1e308");
        assert_eq!(shortened("0.1"), "0.1");
        let long = "a".repeat(5_000);
        let short = message(&format!("no agent \"{long}\": the scenario has \"b\""));
        assert_eq!(
            short,
            format!(
                "no agent \"{}… (5000 characters)\": the scenario has \"b\"",
                &long[..SHOWN]
            )
        );
        assert!(message(&"ab ".repeat(10_000)).ends_with("… (shortened)"));
        assert_eq!(
            message(&format!("must be less than 5, got 1{} m", "0".repeat(200))),
            "must be less than 5, got 1e200 m"
        );
    }

    proptest! {
        #[test]
        fn prop_messages_are_printable_and_words_are_kept(text in any::<String>()) {
            let message = message(&text);
            prop_assert!(message.chars().all(|c| matches!(c, '\n' | '\t') || !acts(c)));
            if text.len() <= LONGEST_NUMBER {
                prop_assert_eq!(&message[..], &escaped(&text)[..]);
            }
        }

    }
}
