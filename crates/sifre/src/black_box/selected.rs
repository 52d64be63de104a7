//! A black box that receives only some of the channels.

use super::{BlackBox, BlackBoxError, Channel};

/// Channels named in an error's message.
const NAMED: usize = 8;

/// Which channels: names with `*` for any run of characters, as in `alpha.*` or `*.position.z`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Selection {
    /// A channel is selected if one of these fits; all are if the list is empty.
    pub patterns: Vec<String>,
}

impl Selection {
    /// Whether a channel of this name is selected.
    pub fn has(&self, name: &str) -> bool {
        self.patterns.is_empty() || self.patterns.iter().any(|pattern| fits(pattern, name))
    }

    /// The places of the selected channels, in order.
    ///
    /// # Errors
    /// [`BlackBoxError::NothingSelected`] if a pattern fits no channel.
    pub fn places(&self, channels: &[Channel]) -> Result<Vec<usize>, BlackBoxError> {
        let idle = |pattern: &&String| !channels.iter().any(|channel| fits(pattern, &channel.name));
        if let Some(pattern) = self.patterns.iter().find(idle) {
            let names: Vec<&str> = channels.iter().map(|c| c.name.as_str()).take(NAMED).collect();
            return Err(BlackBoxError::NothingSelected {
                pattern: pattern.clone(),
                known: format!("{} …", names.join(", ")),
            });
        }
        let selected = channels.iter().enumerate().filter(|(_, c)| self.has(&c.name));
        Ok(selected.map(|(place, _)| place).collect())
    }
}

/// Whether a pattern fits a name. Greedy from the left with one place to come back to, so linear in practice.
fn fits(pattern: &str, name: &str) -> bool {
    let Some((head, rest)) = pattern.split_once('*') else {
        return pattern == name;
    };
    let Some(mut left) = name.strip_prefix(head) else {
        return false;
    };
    let mut parts: Vec<&str> = rest.split('*').collect();
    let tail = parts.pop().unwrap_or("");
    for part in parts {
        match left.find(part) {
            Some(at) => left = &left[at + part.len()..],
            None => return false,
        }
    }
    left.ends_with(tail)
}

/// Hands the selected channels on to another black box.
#[derive(Debug)]
pub struct Selected<B> {
    /// Where the selected channels go.
    pub inner: B,
    selection: Selection,
    places: Vec<usize>,
    row: Vec<f64>,
}

impl<B: BlackBox> Selected<B> {
    /// The selected channels to this black box.
    pub fn new(inner: B, selection: Selection) -> Self {
        Self {
            inner,
            selection,
            places: Vec::new(),
            row: Vec::new(),
        }
    }
}

impl<B: BlackBox> BlackBox for Selected<B> {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), BlackBoxError> {
        self.places = self.selection.places(channels)?;
        self.row = vec![0.0; self.places.len()];
        let selected: Vec<Channel> = self.places.iter().map(|&k| channels[k].clone()).collect();
        self.inner.begin(&selected)
    }

    fn record(&mut self, time_ns: u64, row: &[f64]) -> Result<(), BlackBoxError> {
        for (to, &place) in self.row.iter_mut().zip(&self.places) {
            *to = row[place];
        }
        self.inner.record(time_ns, &self.row)
    }

    fn finish(&mut self) -> Result<(), BlackBoxError> {
        self.inner.finish()
    }
}

/// Whichever kind of black box was chosen at run time.
impl BlackBox for Box<dyn BlackBox> {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), BlackBoxError> {
        self.as_mut().begin(channels)
    }

    fn record(&mut self, time_ns: u64, row: &[f64]) -> Result<(), BlackBoxError> {
        self.as_mut().record(time_ns, row)
    }

    fn finish(&mut self) -> Result<(), BlackBoxError> {
        self.as_mut().finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::black_box::{Frame, MemoryBox, Role};

    #[test]
    fn exact_patterns() {
        for (pattern, name, expected) in [
            ("alpha.*", "alpha.position.x", true),
            ("alpha.*", "alphabet.position.x", false),
            ("*.position.*", "alpha.position.x", true),
            ("*.position.*", "alpha.velocity.x", false),
            ("*", "anything", true),
            ("*x", "axbx", true),
            ("a*b*c", "abbc", true),
            ("a*b*c", "acb", false),
            ("level", "level", true),
            ("level", "levels", false),
        ] {
            assert_eq!(fits(pattern, name), expected, "{pattern} on {name}");
        }
    }

    fn channels() -> Vec<Channel> {
        ["a.x", "a.y", "b.x"]
            .map(|name| Channel::new(name, Role::State, "m", Frame::World))
            .to_vec()
    }

    #[test]
    fn exact_only_the_selected_channels_arrive() {
        let patterns = vec!["*.x".to_owned()];
        let mut selected = Selected::new(MemoryBox::default(), Selection { patterns });
        selected.begin(&channels()).unwrap();
        selected.record(7, &[1.0, 2.0, 3.0]).unwrap();
        selected.finish().unwrap();
        let recording = selected.inner.recording;
        assert_eq!(recording.channels().len(), 2);
        assert_eq!(recording.rows().next().unwrap().values, [1.0, 3.0]);
    }

    #[test]
    fn exact_a_pattern_that_fits_nothing_is_an_error() {
        let patterns = vec!["a.*".to_owned(), "c.*".to_owned()];
        let mut selected = Selected::new(MemoryBox::default(), Selection { patterns });
        let error = selected.begin(&channels()).unwrap_err();
        assert!(matches!(&error, BlackBoxError::NothingSelected { pattern, .. } if pattern == "c.*"));
        assert!(error.to_string().contains("a.x"));
    }
}
