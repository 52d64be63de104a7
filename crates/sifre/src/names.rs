//! Names of agents, each found at once however many there are.

use std::collections::HashMap;
use std::ops::Deref;

/// Different names in the order in which they were given.
#[derive(Clone, Debug, Default)]
pub(crate) struct Names {
    all: Vec<String>,
    places: HashMap<String, usize>,
}

impl Names {
    /// These names.
    ///
    /// # Errors
    /// The first that is among them twice.
    pub(crate) fn new(all: impl IntoIterator<Item = String>) -> Result<Self, String> {
        let mut names = Self::default();
        all.into_iter().try_for_each(|name| names.add(name))?;
        Ok(names)
    }

    /// Adds a name.
    ///
    /// # Errors
    /// The name, if it is one of them.
    pub(crate) fn add(&mut self, name: String) -> Result<(), String> {
        if self.places.contains_key(&name) {
            return Err(name);
        }
        self.places.insert(name.clone(), self.all.len());
        self.all.push(name);
        Ok(())
    }

    /// The place of a name.
    pub(crate) fn find(&self, name: &str) -> Option<usize> {
        #[cfg(test)]
        tests::LOOKUPS.set(tests::LOOKUPS.get() + 1);
        self.places.get(name).copied()
    }
}

impl Deref for Names {
    type Target = [String];

    fn deref(&self) -> &[String] {
        &self.all
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use std::cell::Cell;

    thread_local! {
        /// Names looked up by this thread.
        pub(crate) static LOOKUPS: Cell<usize> = const { Cell::new(0) };
    }

    #[test]
    fn exact_names_are_found_and_none_is_there_twice() {
        let mut names = Names::new(["a", "b"].map(str::to_owned)).unwrap();
        assert_eq!((names.find("b"), names.find("c")), (Some(1), None));
        assert_eq!(names.add("a".to_owned()), Err("a".to_owned()));
        assert_eq!(&names[..], ["a", "b"]);
    }
}
