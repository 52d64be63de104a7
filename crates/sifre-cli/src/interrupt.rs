//! Ctrl-C: the first asks the run to end, so that files are complete; the second ends the program at once.

use crate::exit::{Exit, Failure};
use scenario::{Files, Flown, Keep, Scenario};
use sifre::Progress;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);

/// Listens for Ctrl-C from now on.
pub(crate) fn listen() {
    // A handler that can't be set leaves Ctrl-C as it was.
    let _ = ctrlc::set_handler(|| {
        if ASKED.swap(true, Ordering::Relaxed) {
            std::process::exit(Exit::Interrupted.code().into());
        }
    });
}

/// Whether Ctrl-C was pressed.
pub(crate) fn asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}

/// Whether a run should continue.
pub(crate) fn flow() -> ControlFlow<()> {
    if asked() {
        ControlFlow::Break(())
    } else {
        ControlFlow::Continue(())
    }
}

/// Flies a scenario to its end, or until Ctrl-C.
pub(crate) fn fly(scenario: &Scenario, files: &dyn Files, keep: &Keep) -> Result<Flown, Failure> {
    Ok(scenario.build(files)?.start()?.fly(keep, &mut watch())?)
}

/// An observer that ends a run when asked.
pub(crate) fn watch() -> impl FnMut(&Progress) -> ControlFlow<()> {
    |_| flow()
}
