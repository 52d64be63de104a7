//! The page in a real browser.
//!
//! Needs a Chromium (in the path, or named by the variable `CHROMIUM`). Where there is none the tests say so and pass, unless
//! the variable `REQUIRE_BROWSER` is set, as it is where changes are checked.

use crate::support::{CHANGE_S, DURATION_S, NASTY, column, flight, scene};
use animate::{Browser, LEVEL_COLOURS, Options, Page, Scene, Size, html};
use serde_json::{Value, json};

const SIZE: Size = Size {
    width: 900,
    height: 560,
    scale: 1.0,
};

fn browser() -> Option<Browser> {
    let found = Browser::find();
    if found.is_none() {
        assert!(
            std::env::var_os("REQUIRE_BROWSER").is_none(),
            "no Chromium found, though REQUIRE_BROWSER is set"
        );
        eprintln!("skipped: no Chromium on this machine");
    }
    found
}

fn page() -> String {
    html(&flight(), &scene(), &Options::default()).unwrap()
}

/// Opens a page, runs a script as a reader would act, and gives what it returned. Nothing may be written to the console.
fn act(browser: &Browser, page: &str, script: &str) -> Value {
    act_on(&mut browser.open(page, "", SIZE).unwrap(), script)
}

fn act_on(page: &mut Page, script: &str) -> Value {
    let acting = format!(
        "(async () => {{
         const wait = (ms) => new Promise((done) => setTimeout(done, ms));
         const drawn = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
         const at = (t) => {{ viewer.setTime(t); return drawn(); }};
         const $ = (id) => document.getElementById(id);
         const press = (key) => {{ window.dispatchEvent(new KeyboardEvent('keydown', {{ key }})); return drawn(); }};
         {script}
         }})()"
    );
    let result = page.evaluate(&acting).unwrap();
    assert_eq!(page.console(), [""; 0], "the console");
    result
}

#[test]
fn prop_plays_pauses_and_moves_in_time() {
    let Some(browser) = browser() else { return };
    let seen = act(
        &browser,
        &page(),
        "const seen = { start: viewer.time };
         $('play').click(); while (viewer.time < 0.2) await drawn();
         seen.played = viewer.time; seen.word = $('play').textContent;
         $('play').click(); await drawn();
         seen.paused = viewer.time; await wait(100); seen.still = viewer.time;
         $('slider').value = 2; $('slider').dispatchEvent(new Event('input')); await drawn();
         seen.slid = viewer.time; seen.clock = $('clock').textContent;
         await press('ArrowRight'); seen.stepped = viewer.time;
         await press('End'); seen.end = viewer.time; seen.slider = Number($('slider').value);
         await press('v'); seen.view = $('view').value;
         await press(' '); await drawn(); seen.again = viewer.time; seen.playing = viewer.playing;
         seen.message = $('message').hidden;
         return seen;",
    );
    let time = |name: &str| seen[name].as_f64().expect(name);
    assert_eq!(time("start"), 0.0);
    // The script waits until it has played for 0.2 s; the browser's patience ends if it never does.
    assert!(time("played") >= 0.2 && time("played") < DURATION_S, "{seen}");
    assert_eq!(seen["word"], "Pause");
    assert_eq!(time("paused"), time("still"));
    // The slider has 5000 steps.
    assert!((time("slid") - 2.0).abs() <= DURATION_S / 5000.0);
    assert_eq!(seen["clock"], "t = 2.00 s of 3.00 s");
    assert!((time("stepped") - time("slid") - 0.1).abs() < 1e-12);
    assert_eq!((time("end"), time("slider")), (DURATION_S, DURATION_S));
    assert_eq!(seen["view"], "station");
    // At the end, playing begins from the start.
    assert!(
        time("again") > 0.0 && time("again") < DURATION_S && seen["playing"] == json!(true),
        "{seen}"
    );
    assert_eq!(seen["message"], json!(true), "the error message is hidden");
}

#[test]
fn agree_the_picture_with_frames_levels_and_the_engine_s_camera() {
    let Some(browser) = browser() else { return };
    let recording = flight();
    let rows = [0, recording.len() / 3, recording.len() - 1];
    let times: Vec<f64> = recording.times_s().collect();
    let names: Vec<String> = ["x", "y", "z"]
        .iter()
        .map(|axis| format!("station.target.{axis}"))
        .collect();
    let target: Vec<Vec<f64>> = names.iter().map(|name| column(&recording, name)).collect();
    let asked: Vec<Value> = rows
        .iter()
        .map(|&k| json!([times[k], [target[0][k], target[1][k], target[2][k]]]))
        .collect();
    let script = format!(
        "const seen = {{ axes: viewer.axesOfW(), images: [], labels: [] }};
         for (const [t, target] of {}) {{
             await at(t);
             seen.images.push(viewer.imageOf('station', target));
         }}
         for (const t of [{}, {}]) {{
             await at(t);
             seen.labels.push([...document.querySelectorAll('.label')].map((label) => label.textContent));
         }}
         return seen;",
        json!(asked),
        CHANGE_S - 0.1,
        CHANGE_S + 0.1
    );
    let seen = act(&browser, &page(), &script);

    // North, east and down where three.js has x right, y up, z to the reader: a rotation, N × E = D.
    let axes: Vec<nalgebra::Vector3<f64>> = (0..3)
        .map(|i| nalgebra::Vector3::from_fn(|j, _| seen["axes"][i][j].as_f64().expect("a number")))
        .collect();
    let expected = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]];
    for (axis, expected) in axes.iter().zip(expected) {
        assert!((axis - nalgebra::Vector3::from(expected)).norm() < 1e-14);
    }
    assert!((axes[0].cross(&axes[1]) - axes[2]).norm() < 1e-14);

    // The viewer's camera and the engine's see the target at the same place.
    let image = ["x", "y"].map(|axis| column(&recording, &format!("station.image.{axis}")));
    for (i, &k) in rows.iter().enumerate() {
        for (j, recorded) in image.iter().enumerate() {
            let drawn = seen["images"][i][j].as_f64().expect("a number");
            // The attitude is written to five decimals: 2e-5 rad times 667 px, and a little for matrices in single precision.
            assert!(
                (drawn - recorded[k]).abs() < 0.03,
                "row {k}: {drawn} px drawn, {} px recorded",
                recorded[k]
            );
        }
    }
    assert!(image[0][rows[0]].abs() > 10.0, "the station looks aside at first");
    assert_eq!(
        seen["labels"],
        json!([
            ["alpha · level 5", NASTY, "station"],
            ["alpha · level 3", NASTY, "station"]
        ])
    );
}

/// Pixels of a picture near a place that satisfy a condition on red, green and blue from 0 to 255.
fn count(picture: &[u8], place: [f64; 2], condition: impl Fn([f64; 3]) -> bool) -> usize {
    let mut reader = png::Decoder::new(std::io::Cursor::new(picture))
        .read_info()
        .unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!((info.width, info.height), (SIZE.width, SIZE.height));
    let samples = info.color_type.samples();
    let near = |k: usize| {
        let (x, y) = ((k % SIZE.width as usize) as f64, (k / SIZE.width as usize) as f64);
        (x - place[0]).hypot(y - place[1]) < 40.0
    };
    let all = pixels.chunks_exact(samples).enumerate();
    all.filter(|(k, p)| near(*k) && condition([p[0], p[1], p[2]].map(f64::from)))
        .count()
}

/// Whether a colour has the hue of another, whatever the light on it: its chroma points the same way, within 15°.
fn has_hue(of: &str) -> impl Fn([f64; 3]) -> bool {
    let part = |i: usize| f64::from(u8::from_str_radix(&of[i..i + 2], 16).expect("#rrggbb"));
    let chroma = |c: [f64; 3]| {
        let grey = c.iter().sum::<f64>() / 3.0;
        nalgebra::Vector3::from(c.map(|x| x - grey))
    };
    let wanted = chroma([part(1), part(3), part(5)]);
    move |c| chroma(c).norm() > 40.0 && chroma(c).angle(&wanted) < 15_f64.to_radians()
}

#[test]
fn prop_every_agent_is_in_the_picture() {
    let Some(browser) = browser() else { return };
    // At the first instant there are no trails, and names are hidden: what has an agent's colour is the agent.
    let html = page().replace("</style>", ".label { opacity: 0; }</style>");
    let mut page = browser.open(&html, "t=0", SIZE).unwrap();
    let places = act_on(
        &mut page,
        "return viewer.agents.map((agent) => [agent.name, viewer.whereOnScreen(agent.name)]);",
    );
    let places: Vec<(&str, [f64; 2])> = places
        .as_array()
        .expect("agents")
        .iter()
        .map(|entry| {
            let part = |axis| entry[1][axis].as_f64().expect("on the screen");
            (entry[0].as_str().expect("a name"), [part("x"), part("y")])
        })
        .collect();
    let picture = page.screenshot().unwrap();
    // The place of the large picture that is farthest from all agents; the axes' names are below.
    let free = |p: &[f64; 2]| {
        let distances = places.iter().map(|(_, q)| (p[0] - q[0]).hypot(p[1] - q[1]));
        distances.fold(f64::INFINITY, f64::min)
    };
    let spots = (1..9).flat_map(|i| (2..8).map(move |j| [50.0 * f64::from(i), 50.0 * f64::from(j)]));
    let elsewhere = spots
        .max_by(|a, b| free(a).total_cmp(&free(b)))
        .expect("48 places");

    // A body of 0.4 m at some 8 m covers more than 100 px; its parts in the colour looked for, a quarter of them.
    let least = 25;
    let is_dark = |c: [f64; 3]| c.iter().all(|&x| x < 90.0);
    for (name, place) in &places {
        let there = |p: [f64; 2]| match *name {
            "alpha" => count(&picture, p, has_hue(LEVEL_COLOURS[4])),
            "station" => count(&picture, p, has_hue("#56b4e9")),
            _ => count(&picture, p, is_dark),
        };
        assert!(there(*place) > least, "{name}: {} px", there(*place));
        assert_eq!(there(elsewhere), 0, "{name} elsewhere");
    }
}

#[test]
fn prop_scenes_without_stations_or_motion_are_shown() {
    let Some(browser) = browser() else { return };
    let flight = flight();
    let mut one = sifre::Recording::new(flight.channels().to_vec());
    let first = flight.rows().next().unwrap();
    one.push(first.time_ns, first.values).unwrap();
    let alone = Scene::new("").quadrotor("alpha", 0.2);
    for recording in [&flight, &one] {
        let page = html(recording, &alone, &Options::default()).unwrap();
        let script = "viewer.play(); await drawn(); await press('v');
            return [$('message').hidden, $('inset').hidden, viewer.view];";
        assert_eq!(act(&browser, &page, script), json!([true, true, ""]));
    }
}
