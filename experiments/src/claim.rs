//! Claims: what a figure is said to show, registered before the run and judged by it.
//!
//! A claim that turns out not to hold with our parameters stays, registered as not holding with the reason. The
//! run fails when an outcome differs from the registered one, in either direction.

use serde::{Deserialize, Serialize};

/// A statement that the run of an item checks, with the outcome registered for it.
///
/// ```
/// use experiments::claim::Claim;
///
/// const COINCIDE: Claim = Claim::holds("levels 1 and 2 coincide");
/// const FALLS: Claim = Claim::does_not_hold("the error falls from c1 to c3", "c2 already cancels the rotor's lag");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Claim {
    /// The statement, one sentence without the full stop. Unique within its item.
    pub text: &'static str,
    /// The outcome registered in code.
    pub expected: Expected,
}

/// The registered outcome of a [`Claim`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expected {
    /// The claim holds with our parameters.
    Holds,
    /// The claim does not hold with our parameters.
    DoesNotHold {
        /// Why it does not hold, one sentence without the full stop.
        reason: &'static str,
    },
}

impl Claim {
    /// A claim registered as holding.
    pub const fn holds(text: &'static str) -> Self {
        Self {
            text,
            expected: Expected::Holds,
        }
    }

    /// A claim registered as not holding, with the reason.
    pub const fn does_not_hold(text: &'static str, reason: &'static str) -> Self {
        Self {
            text,
            expected: Expected::DoesNotHold { reason },
        }
    }
}

/// What one run found for one claim.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The claim's text, which ties the finding to the registered claim.
    pub text: String,
    /// Whether the claim holds in this run.
    pub pass: bool,
    /// The measured number with its unit, in words a reader understands without the code.
    pub measured: String,
}

/// A judged claim, as `summary.json` stores it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ClaimRecord {
    /// The statement.
    pub text: String,
    /// `holds` or `does-not-hold`, as registered in code.
    pub expected: ExpectedRecord,
    /// Whether the claim holds in this run.
    pub pass: bool,
    /// The measured number with its unit.
    pub measured: String,
    /// Why the claim is registered as not holding.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// The registered outcome as `summary.json` stores it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ExpectedRecord {
    /// Registered as holding.
    Holds,
    /// Registered as not holding.
    DoesNotHold,
}

impl ClaimRecord {
    /// Whether the run found what was registered.
    pub fn as_registered(&self) -> bool {
        self.pass == (self.expected == ExpectedRecord::Holds)
    }

    /// The outcome in words, for the terminal and the gallery.
    pub fn verdict(&self) -> &'static str {
        match (self.expected, self.pass) {
            (ExpectedRecord::Holds, true) => "holds",
            (ExpectedRecord::DoesNotHold, false) => "does not hold, as registered",
            (ExpectedRecord::Holds, false) => "does NOT hold, but is registered as holding",
            (ExpectedRecord::DoesNotHold, true) => "holds, but is registered as not holding",
        }
    }
}

/// A fault in the bookkeeping between an item's registered claims and its findings.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ClaimFault {
    /// A registered claim has no finding.
    #[error("claim \"{text}\" was not checked")]
    NotChecked {
        /// The claim's text.
        text: String,
    },
    /// A registered claim has more than one finding.
    #[error("claim \"{text}\" was checked {times} times")]
    CheckedRepeatedly {
        /// The claim's text.
        text: String,
        /// How many findings there are.
        times: usize,
    },
    /// A finding belongs to no registered claim.
    #[error("claim \"{text}\" was checked but is not registered")]
    NotRegistered {
        /// The finding's text.
        text: String,
    },
}

/// Joins registered claims and findings: one record per claim that was checked, and every fault.
pub fn judge(registered: &[Claim], findings: &[Finding]) -> (Vec<ClaimRecord>, Vec<ClaimFault>) {
    let mut records = Vec::new();
    let mut faults = Vec::new();
    for claim in registered {
        let matching: Vec<_> = findings
            .iter()
            .filter(|finding| finding.text == claim.text)
            .collect();
        match matching.as_slice() {
            [] => faults.push(ClaimFault::NotChecked {
                text: claim.text.into(),
            }),
            [finding] => records.push(record(claim, finding)),
            several => {
                let times = several.len();
                faults.push(ClaimFault::CheckedRepeatedly {
                    text: claim.text.into(),
                    times,
                });
            }
        }
    }
    for finding in findings {
        if !registered.iter().any(|claim| claim.text == finding.text) {
            faults.push(ClaimFault::NotRegistered {
                text: finding.text.clone(),
            });
        }
    }
    (records, faults)
}

fn record(claim: &Claim, finding: &Finding) -> ClaimRecord {
    let (expected, reason) = match claim.expected {
        Expected::Holds => (ExpectedRecord::Holds, None),
        Expected::DoesNotHold { reason } => (ExpectedRecord::DoesNotHold, Some(reason.to_owned())),
    };
    ClaimRecord {
        text: finding.text.clone(),
        expected,
        pass: finding.pass,
        measured: finding.measured.clone(),
        reason,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOLDS: Claim = Claim::holds("levels 1 and 2 coincide");
    const FAILS: Claim = Claim::does_not_hold("the error falls", "the lag is cancelled already");

    fn finding(claim: Claim, pass: bool) -> Finding {
        Finding {
            text: claim.text.into(),
            pass,
            measured: "0.3 mm".into(),
        }
    }

    #[test]
    fn prop_each_claim_is_checked_exactly_once() {
        let (records, faults) = judge(&[HOLDS, FAILS], &[finding(FAILS, false), finding(HOLDS, true)]);
        assert!(faults.is_empty());
        assert_eq!(
            records.iter().map(|r| r.text.as_str()).collect::<Vec<_>>(),
            [HOLDS.text, FAILS.text]
        );
        assert!(records.iter().all(ClaimRecord::as_registered));
        assert_eq!(records[1].reason.as_deref(), Some("the lag is cancelled already"));
    }

    #[test]
    fn prop_missing_extra_and_repeated_findings_are_faults() {
        let stray = Finding {
            text: "unheard of".into(),
            pass: true,
            measured: String::new(),
        };
        let (records, faults) = judge(
            &[HOLDS, FAILS],
            &[finding(FAILS, false), finding(FAILS, false), stray],
        );
        assert!(records.is_empty());
        let expected = [
            ClaimFault::NotChecked {
                text: HOLDS.text.into(),
            },
            ClaimFault::CheckedRepeatedly {
                text: FAILS.text.into(),
                times: 2,
            },
            ClaimFault::NotRegistered {
                text: "unheard of".into(),
            },
        ];
        assert_eq!(faults, expected);
    }

    #[test]
    fn prop_an_unexpected_outcome_differs_in_either_direction() {
        let (records, _) = judge(&[HOLDS, FAILS], &[finding(HOLDS, false), finding(FAILS, true)]);
        assert!(records.iter().all(|record| !record.as_registered()));
    }
}
