use super::*;

#[test]
fn probe() {
    for starts in [3] {
    let t = std::time::Instant::now();
    let tuned = tune(&Vehicle::qball_x4(), &TuningOptions{starts, ..TuningOptions::default()}).unwrap();
    eprintln!("{:?}", t.elapsed());
    for l in &tuned.loops {
        eprintln!("{} {:?} cost {} before {} n={} {:?}", l.tuned, l.gains, l.cost, l.cost_before, l.history.len(), l.starts);
    }
    }
}
