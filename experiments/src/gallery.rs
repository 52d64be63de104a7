//! `index.html`: all items of the last runs on one page that needs nothing but the files beside it.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use crate::claim::ClaimRecord;
use crate::item::Item;
use crate::output::{OutputError, animation_name, save_file};
use crate::plot::svg::escape;
use crate::plot::text;
use crate::summary::{Counts, Record, Status, Summary};

const STYLE: &str = include_str!("gallery.css");

/// Writes the gallery into the folder.
///
/// # Errors
/// The file cannot be written.
pub fn save(items: &[Item], summary: &Summary, folder: &Path) -> Result<(), OutputError> {
    let table = |id: &str| fs::read_to_string(folder.join(format!("{id}.html"))).unwrap_or_default();
    save_file(&folder.join("index.html"), page(items, summary, table).as_bytes())
}

/// The gallery as HTML; `table` gives the table of an item as a fragment.
pub fn page(items: &[Item], summary: &Summary, table: impl Fn(&str) -> String) -> String {
    let mut chapters: Vec<&str> = items.iter().map(Item::chapter).collect();
    chapters.dedup();
    let mut contents = String::new();
    let mut body = String::new();
    for chapter in chapters {
        let name = chapter_name(chapter);
        let _ = write!(
            contents,
            "<li><a href=\"#chapter-{chapter}\">{name}</a><div class=\"ids\">"
        );
        let _ = writeln!(body, "<section>\n<h2 id=\"chapter-{chapter}\">{name}</h2>");
        for item in items.iter().filter(|item| item.chapter() == chapter) {
            let record = summary.get(item.id);
            let short = if item.id.starts_with("table-") {
                format!("T {}", item.number())
            } else {
                item.id.into()
            };
            let _ = write!(
                contents,
                "<a class=\"{}\" href=\"#{}\">{short}</a> ",
                mood(record),
                item.id
            );
            body += &article(item, record, &table);
        }
        contents += "</div></li>\n";
        body += "</section>\n";
    }
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>Figures and tables</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n<nav>\n<h1>Figures and tables</h1>\n{}<ul>\n{contents}</ul>\n</nav>\n\
         <main>\n{body}</main>\n</body>\n</html>\n",
        totals(summary)
    )
}

fn chapter_name(chapter: &str) -> String {
    match chapter {
        // Not of the thesis' chapters.
        "beyond" => return "Beyond: resolution and energy".to_owned(),
        "est" => return "Beyond: state estimation".to_owned(),
        _ => {}
    }
    let title = match chapter {
        "1" => "Introduction",
        "2" => "Background",
        "3" => "Forces and moments",
        "4" => "Identification",
        "5" => "Models at several resolutions",
        "6" => "Non-linear dynamic inversion",
        "7" => "Wireless power transmission",
        "A" => "Simulation engine",
        "B" => "Motion capture",
        "C" => "Flight tests",
        "E" => "Calibration and rotors",
        "F" => "Stability",
        "G" => "Properties",
        _ => "",
    };
    let noun = if chapter.starts_with(|c: char| c.is_ascii_digit()) {
        "Chapter"
    } else {
        "Appendix"
    };
    let separator = if title.is_empty() { "" } else { ". " };
    format!("{noun} {chapter}{separator}{title}")
}

/// Class of an item's link in the contents.
fn mood(record: Option<&Record>) -> &'static str {
    match record {
        None => "absent",
        Some(record) if !record.is_as_registered() => "bad",
        Some(Record {
            status: Status::NotReproducible { .. },
            ..
        }) => "absent",
        Some(_) => "good",
    }
}

fn totals(summary: &Summary) -> String {
    let drawn = summary
        .items
        .iter()
        .filter(|record| record.status == Status::Drawn)
        .count();
    let claims = Counts::of(&summary.items);
    let Counts { held, not_held, .. } = claims;
    let seconds: f64 = summary.items.iter().map(|record| record.seconds).sum();
    let bad = summary.items.iter().filter(|record| !record.is_as_registered());
    let bad: Vec<String> = bad
        .map(|record| format!("<a href=\"#{0}\">{0}</a>", record.id))
        .collect();
    let alarm = match bad.as_slice() {
        [] => String::new(),
        bad => format!("<p class=\"error\">To be looked at: {}</p>\n", bad.join(", ")),
    };
    format!(
        "<p class=\"totals\">{drawn} drawn in {seconds:.1} s. Of {} claims, {held} hold and {not_held} do not hold, as \
         registered.</p>\n{alarm}",
        claims.total()
    )
}

fn article(item: &Item, record: Option<&Record>, table: &impl Fn(&str) -> String) -> String {
    let title = text::html(item.title);
    let mut out = format!(
        "<article id=\"{}\">\n<h3><span>{}</span> {title}</h3>\n",
        item.id,
        item.heading()
    );
    let Some(record) = record else {
        let _ = writeln!(
            out,
            "<p>{}</p>\n<p class=\"absent\">Not made yet.</p>\n</article>",
            text::html(item.description)
        );
        return out;
    };
    if record.files.iter().any(|file| file.ends_with(".svg")) {
        let _ = writeln!(
            out,
            "<a href=\"{0}.svg\"><img src=\"{0}.svg\" alt=\"{1}: {2}\" loading=\"lazy\"></a>",
            item.id,
            item.heading(),
            escape(&text::plain(item.title))
        );
    }
    out += &animation(item, record);
    if record.files.contains(&format!("{}.html", item.id)) {
        let _ = write!(out, "<div class=\"scroll\">{}</div>", table(item.id));
    }
    let _ = writeln!(out, "<p>{}</p>", text::html(item.description));
    for note in &record.notes {
        let _ = writeln!(out, "<p class=\"note\">{}</p>", text::html(note));
    }
    out += &status_line(&record.status);
    out += &claims(&record.claims);
    out += &footer(item, record);
    out + "</article>\n"
}

/// The still of an animation, if there is one, and the way to the animation.
fn animation(item: &Item, record: &Record) -> String {
    let page = animation_name(item.id);
    if !record.files.contains(&page) {
        return String::new();
    }
    let still = format!("{}.png", item.id);
    if record.files.contains(&still) {
        let words = escape(&text::plain(item.title));
        let image = format!(
            "<img src=\"{still}\" alt=\"{}: {words}\" loading=\"lazy\">",
            item.heading()
        );
        format!("<a href=\"{page}\">{image}</a>\n<p><a href=\"{page}\">Play the animation</a></p>\n")
    } else {
        format!(
            "<p><a href=\"{page}\">Play the animation</a> (no still: there was no Chromium to draw it)</p>\n"
        )
    }
}

fn status_line(status: &Status) -> String {
    match status {
        Status::Drawn => String::new(),
        Status::NotReproducible { reason } => {
            format!("<p class=\"absent\">Not reproducible: {}.</p>\n", escape(reason))
        }
        Status::Failed { error } => format!("<p class=\"error\">Failed: {}</p>\n", escape(error)),
    }
}

fn claims(claims: &[ClaimRecord]) -> String {
    if claims.is_empty() {
        return String::new();
    }
    let row = |claim: &ClaimRecord| {
        let class = match (claim.as_registered(), claim.pass) {
            (true, true) => "good",
            (true, false) => "known",
            (false, _) => "bad",
        };
        let reason = claim
            .reason
            .as_ref()
            .map(|r| format!(", because {}", text::html(r)))
            .unwrap_or_default();
        format!(
            "<li class=\"{class}\"><b>{}</b> {}<br><small>measured {}{reason}</small></li>\n",
            claim.verdict(),
            text::html(&claim.text),
            text::html(&claim.measured)
        )
    };
    format!(
        "<ul class=\"claims\">\n{}</ul>\n",
        claims.iter().map(row).collect::<String>()
    )
}

fn footer(item: &Item, record: &Record) -> String {
    let link = |file: &String| format!("<a href=\"{file}\">{file}</a>", file = escape(file));
    let shown = record
        .files
        .iter()
        .filter(|file| **file != format!("{}.html", item.id));
    let mut parts = Vec::new();
    if record.status == Status::Drawn {
        parts.push(item.origin.words().to_owned());
        let quick = if record.quick { " (quick run)" } else { "" };
        parts.push(format!("{:.2} s{quick}", record.seconds));
    }
    parts.extend(shown.map(link));
    if parts.is_empty() {
        String::new()
    } else {
        format!("<p class=\"footer\">{}</p>\n", parts.join(" · "))
    }
}
