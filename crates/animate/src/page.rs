//! The page: template, style, three.js, viewer and data in one string.

use crate::Options;
use crate::columns::Columns;
use crate::data::Data;
use crate::error::AnimateError;
use crate::scene::Scene;
use sifre::Recording;

const TEMPLATE: &str = include_str!("../viewer/page.html");
const STYLE: &str = include_str!("../viewer/style.css");
const THREE: &str = include_str!("../vendor/three.bundle.js");

/// The licence of three.js asks to be in all copies.
const LICENCE: &str = include_str!("../vendor/LICENSE-three");

/// The viewer's parts; they share one scope.
const VIEWER: [&str; 11] = [
    include_str!("../viewer/data.js"),
    include_str!("../viewer/frames.js"),
    include_str!("../viewer/colours.js"),
    include_str!("../viewer/models.js"),
    include_str!("../viewer/agents.js"),
    include_str!("../viewer/hud.js"),
    include_str!("../viewer/plots.js"),
    include_str!("../viewer/labels.js"),
    include_str!("../viewer/controls.js"),
    include_str!("../viewer/stage.js"),
    include_str!("../viewer/main.js"),
];

/// The animation of a recording as one HTML file that needs nothing else: no other file, no network.
///
/// # Errors
/// A recording without rows, a scene that doesn't fit it, numbers that can't be drawn.
pub fn html(recording: &Recording, scene: &Scene, options: &Options) -> Result<String, AnimateError> {
    check(recording, scene)?;
    if options.max_frames < 2 {
        return Err(AnimateError::TooFewFrames {
            max_frames: options.max_frames,
        });
    }
    let columns = Columns::thinned(recording, options.max_frames);
    let data = Data::new(&columns, scene)?;
    let note = note(columns.times_s.len(), recording.len());
    Ok(filled(&[
        ("title", &escaped(&scene.title)),
        ("note", &note),
        ("style", STYLE),
        ("data", &embedded(&data)?),
        ("licence", LICENCE),
        ("three", THREE),
        ("viewer", &VIEWER.concat()),
    ]))
}

/// That there is something to draw, and every agent once.
pub(crate) fn check(recording: &Recording, scene: &Scene) -> Result<(), AnimateError> {
    if recording.is_empty() {
        return Err(AnimateError::EmptyRecording);
    }
    if scene.agents.is_empty() {
        let first = recording.channels().iter().take(8);
        return Err(AnimateError::NoAgents {
            channels: first.map(|channel| channel.name.clone()).collect(),
        });
    }
    for (k, agent) in scene.agents.iter().enumerate() {
        if scene.agents[..k].iter().any(|other| other.name == agent.name) {
            return Err(AnimateError::SameName {
                name: agent.name.clone(),
            });
        }
    }
    Ok(())
}

/// What the reader must know of the data.
fn note(kept: usize, rows: usize) -> String {
    if kept < rows {
        format!("{kept} of {rows} recorded rows")
    } else {
        String::new()
    }
}

/// The template with its places filled, each once, in one pass: what is filled in is not searched again.
fn filled(parts: &[(&str, &str)]) -> String {
    let mut page = String::new();
    let mut rest = TEMPLATE;
    while let Some((before, after)) = rest.split_once("{{") {
        let (name, after) = after.split_once("}}").unwrap_or((after, ""));
        page += before;
        page += parts.iter().find(|part| part.0 == name).map_or("", |part| part.1);
        rest = after;
    }
    page + rest
}

/// JSON that can stand in a script element: without `<` it can't end it.
fn embedded(data: &Data) -> Result<String, AnimateError> {
    Ok(serde_json::to_string(data)?.replace('<', "\\u003c"))
}

/// Text for HTML.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_each_place_of_the_template_is_filled_once() {
        let names = ["title", "note", "style", "data", "licence", "three", "viewer"];
        let marked: Vec<String> = names
            .iter()
            .map(|name| format!("[{name}: {{{{title}}}}]"))
            .collect();
        let parts: Vec<(&str, &str)> = names.iter().zip(&marked).map(|(n, m)| (*n, m.as_str())).collect();
        let page = filled(&parts);
        for (name, mark) in names.iter().zip(&marked) {
            let times = if *name == "title" { 2 } else { 1 };
            assert_eq!(page.matches(mark.as_str()).count(), times, "{name}");
        }
    }

    #[test]
    fn prop_nothing_embedded_ends_a_script_or_evaluates_text() {
        for text in VIEWER.iter().chain([&THREE]) {
            assert!(!text.to_lowercase().contains("</script"));
            assert!(!text.contains("eval(") && !text.contains("new Function"));
        }
    }
}
