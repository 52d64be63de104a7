//! Boundary conditions by name: what a decision variable stands for.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// An axis of the world frame W.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axis {
    /// North.
    X,
    /// East.
    Y,
    /// Down: heights are `−z`.
    Z,
}

/// Which derivative of the position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Order {
    /// Position, m.
    Position,
    /// Velocity, m/s.
    Velocity,
    /// Acceleration, m/s².
    Acceleration,
    /// Jerk, m/s³.
    Jerk,
}

/// Which end of the mission.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// At time 0: index 0.
    Start,
    /// At time T: index f.
    Finish,
}

/// One boundary condition of the trajectory. In files and messages its key: `x_0_m`, `x_dot_f_m_s`, `z_ddot_0_m_s2`, …
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Condition {
    /// Along which axis.
    pub axis: Axis,
    /// Of which derivative.
    pub order: Order,
    /// At which end.
    pub side: Side,
}

/// A name that is none of the boundary conditions.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "unknown decision variable \"{name}\"; names are made of axis, derivative, end and unit, one of {}",
    Condition::all().map(|c| c.key()).collect::<Vec<_>>().join(", ")
)]
pub struct UnknownCondition {
    /// The name.
    pub name: String,
}

impl Axis {
    /// All axes, in the order of vectors.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// Place in a vector.
    pub const fn index(self) -> usize {
        match self {
            Self::X => 0,
            Self::Y => 1,
            Self::Z => 2,
        }
    }

    const fn letter(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
        }
    }
}

impl Order {
    /// All orders, lowest first.
    pub const ALL: [Self; 4] = [Self::Position, Self::Velocity, Self::Acceleration, Self::Jerk];

    /// How often the position is differentiated.
    pub const fn index(self) -> usize {
        match self {
            Self::Position => 0,
            Self::Velocity => 1,
            Self::Acceleration => 2,
            Self::Jerk => 3,
        }
    }

    const fn infix(self) -> &'static str {
        match self {
            Self::Position => "",
            Self::Velocity => "_dot",
            Self::Acceleration => "_ddot",
            Self::Jerk => "_dddot",
        }
    }

    const fn suffix(self) -> &'static str {
        match self {
            Self::Position => "m",
            Self::Velocity => "m_s",
            Self::Acceleration => "m_s2",
            Self::Jerk => "m_s3",
        }
    }

    /// The unit in words of the SI.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Position => "m",
            Self::Velocity => "m/s",
            Self::Acceleration => "m/s²",
            Self::Jerk => "m/s³",
        }
    }
}

impl Side {
    /// Both ends.
    pub const ALL: [Self; 2] = [Self::Start, Self::Finish];

    const fn letter(self) -> &'static str {
        match self {
            Self::Start => "0",
            Self::Finish => "f",
        }
    }
}

impl Condition {
    /// A boundary condition.
    pub const fn new(axis: Axis, order: Order, side: Side) -> Self {
        Self { axis, order, side }
    }

    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        Side::ALL.into_iter().flat_map(|side| {
            Axis::ALL
                .into_iter()
                .flat_map(move |axis| Order::ALL.map(|order| Self::new(axis, order, side)))
        })
    }

    /// Its symbol without the unit: `x_0`, `x_dot_f`.
    pub fn symbol(self) -> String {
        let (axis, infix, side) = (self.axis.letter(), self.order.infix(), self.side.letter());
        format!("{axis}{infix}_{side}")
    }

    /// Its key in files: `x_0_m`, `x_dot_f_m_s`.
    pub fn key(self) -> String {
        format!("{}_{}", self.symbol(), self.order.suffix())
    }
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.key())
    }
}

impl FromStr for Condition {
    type Err = UnknownCondition;

    fn from_str(name: &str) -> Result<Self, UnknownCondition> {
        let unknown = || UnknownCondition {
            name: name.to_owned(),
        };
        Self::all().find(|c| c.key() == name).ok_or_else(unknown)
    }
}

impl TryFrom<String> for Condition {
    type Error = UnknownCondition;

    fn try_from(name: String) -> Result<Self, UnknownCondition> {
        name.parse()
    }
}

impl From<Condition> for String {
    fn from(condition: Condition) -> Self {
        condition.key()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_every_name_leads_back() {
        let all: Vec<_> = Condition::all().collect();
        assert_eq!(all.len(), 24);
        for condition in all {
            assert_eq!(condition.key().parse(), Ok(condition));
        }
        let x_dot_f: Condition = "x_dot_f_m_s".parse().unwrap();
        assert_eq!(x_dot_f.symbol(), "x_dot_f");
    }

    #[test]
    fn exact_an_unknown_name_is_told_the_known_ones() {
        let error = "w_0_m".parse::<Condition>().unwrap_err().to_string();
        assert!(error.contains("\"w_0_m\"") && error.contains("x_dot_f_m_s"));
    }
}
