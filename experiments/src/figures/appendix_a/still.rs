//! The animation of a flight and its still.

use super::encounter::Encounter;
use crate::drawing::Animation;
use crate::item::ItemError;
use animate::{Browser, Options, Size, html};

/// Size of the stills, px: sharp on a page printed at 170 mm width.
const SIZE: Size = Size {
    width: 1200,
    height: 680,
    scale: 2.0,
};

/// The page of a flight, and a still as the address's `hash` asks for it, if there is a browser on this machine.
pub(super) fn animation(flown: &Encounter, title: &str, hash: &str) -> Result<Animation, ItemError> {
    let page = html(&flown.recording, &flown.scene(title), &Options::default())?;
    let still = Browser::find().map(|browser| browser.screenshot(&page, hash, SIZE));
    Ok(Animation {
        page,
        still: still.transpose()?,
    })
}

#[cfg(test)]
mod tests {
    use crate::plot::style::level_style;

    #[test]
    fn agree_levels_have_the_colours_of_the_figures() {
        for (level, colour) in (1..).zip(animate::LEVEL_COLOURS) {
            assert_eq!(level_style(level).colour, colour, "level {level}");
        }
    }
}
