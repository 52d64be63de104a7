use std::fs;

use super::*;
use crate::drawing::{DisplayTable, Drawing};
use crate::item::{Draw, ItemError, Kind, Origin};
use crate::run::run;
use crate::summary::Summary;

const HOLDS: Claim = Claim::holds("it holds");
const FAILS: Claim = Claim::does_not_hold("it fails", "of the test");

const fn item(id: &'static str, claims: &'static [Claim], draw: Draw) -> Item {
    let (title, description) = ("title", "a description");
    Item {
        id,
        title,
        description,
        kind: Kind::Table,
        origin: Origin::Derived,
        claims,
        make: Make::Draw(draw),
    }
}

fn blank() -> Drawing {
    Drawing::table(DisplayTable::new(["a"]))
}

fn good(_: &Context) -> Result<Drawing, ItemError> {
    Ok(blank().check(HOLDS, true, "1 m").check(FAILS, false, "2 m"))
}

fn surprising(_: &Context) -> Result<Drawing, ItemError> {
    Ok(blank().check(HOLDS, true, "1 m").check(FAILS, true, "0 m"))
}

fn forgetful(_: &Context) -> Result<Drawing, ItemError> {
    Ok(blank().check(HOLDS, true, "1 m"))
}

fn failing(_: &Context) -> Result<Drawing, ItemError> {
    Err("x".parse::<f64>().map(|_| ()).expect_err("not a number").into())
}

fn panicking(_: &Context) -> Result<Drawing, ItemError> {
    panic!("a bug at t = {} s", 0.5)
}

const CLAIMS: &[Claim] = &[HOLDS, FAILS];

fn run_in(name: &str, items: &[Item], known: &[Item]) -> (Vec<Record>, PathBuf) {
    let out = std::env::temp_dir().join(format!("experiments-{name}-{}", std::process::id()));
    let context = Context::of_this_repository(true);
    let reference = out.join("reference");
    let options = Options {
        out: out.clone(),
        reference,
        references: References::Ignore,
        jobs: 2,
        context,
    };
    (
        run(items, known, &options, |_| ()).expect("a folder to write to"),
        out,
    )
}

#[test]
fn exact_exit_codes() {
    let cases: [(&str, Draw, u8); 5] = [
        ("table-1.1", good, 0),
        ("table-1.2", surprising, DIFFERS),
        ("table-1.3", forgetful, DIFFERS),
        ("table-1.4", failing, DIFFERS),
        ("table-1.5", panicking, DIFFERS),
    ];
    for (id, draw, expected) in cases {
        let items = [item(id, CLAIMS, draw)];
        let (records, out) = run_in(id, &items, &items);
        assert_eq!(exit_code(&records), expected, "{id}: {records:?}");
        fs::remove_dir_all(out).expect("removed");
    }
}

#[test]
fn prop_a_panic_is_a_failed_item_and_the_others_are_drawn() {
    let items = [item("table-1.5", &[], panicking), item("table-1.1", CLAIMS, good)];
    let (records, out) = run_in("panic", &items, &items);
    assert!(matches!(&records[0].status, Status::Failed { error } if error.contains("a bug at t = 0.5 s")));
    assert_eq!(
        (&records[1].status, records[1].files.as_slice()),
        (&Status::Drawn, &["table-1.1.html".to_owned()][..])
    );
    let gallery = fs::read_to_string(out.join("index.html")).expect("written");
    assert!(gallery.contains("does not hold, as registered") && gallery.contains("a bug at t = 0.5 s"));
    fs::remove_dir_all(out).expect("removed");
}

#[test]
fn prop_a_subset_keeps_the_records_of_the_others() {
    let known = [item("table-1.1", CLAIMS, good), item("table-1.2", CLAIMS, good)];
    run_in("subset", &known, &known);
    let (_, out) = run_in("subset", &[item("table-1.2", CLAIMS, failing)], &known);
    let summary = Summary::load(&out).expect("our own file");
    assert_eq!(summary.get("table-1.1").map(|r| &r.status), Some(&Status::Drawn));
    assert!(matches!(
        summary.get("table-1.2").map(|r| &r.status),
        Some(Status::Failed { .. })
    ));
    fs::remove_dir_all(out).expect("removed");
}

#[test]
fn exact_selection() {
    let known = figures::all();
    let ids = |ids: &[&str], chapters: &[&str]| {
        let words = |list: &[&str]| list.iter().map(|s| (*s).to_owned()).collect::<Vec<_>>();
        select(&known, &words(ids), &words(chapters))
            .map(|items| items.iter().map(|i| i.id).collect::<Vec<_>>())
    };
    assert_eq!(ids(&["6.1", "5.1"], &[]), Ok(vec!["5.1", "6.1"]));
    assert_eq!(ids(&[], &[]).map(|all| all.len()), Ok(known.len()));
    let with_chapter_2: Vec<_> = known
        .iter()
        .filter(|i| i.id == "1.1" || i.chapter() == "2")
        .map(|i| i.id)
        .collect();
    assert!(with_chapter_2.contains(&"2.2"));
    assert_eq!(ids(&["1.1"], &["2"]), Ok(with_chapter_2));
    assert!(
        matches!(ids(&["6.99"], &[]), Err(SelectError::UnknownItem { known, .. }) if known.contains("6.1"))
    );
    assert!(
        matches!(ids(&[], &["12"]), Err(SelectError::UnknownChapter { known, .. }) if known.contains('6'))
    );
}

#[test]
fn prop_bad_usage_is_refused() {
    for bad in [
        ["--jobs", "0"],
        ["--jobs", "many"],
        ["--check", "--quick"],
        ["--check", "--bless"],
    ] {
        let arguments = ["reproduce-figures"].into_iter().chain(bad);
        assert!(Arguments::try_parse_from(arguments).is_err(), "{bad:?}");
    }
}

#[test]
fn exact_list_shows_claims_and_reasons() {
    let text = listing(&[item("table-1.1", CLAIMS, good)]);
    assert!(
        text.contains("claim: it holds")
            && text.contains("registered as not holding: it fails (because of the test)")
    );
}
