//! The table of control laws: one row each, which everybody asks who must know what a law is.
//!
//! A row names a controller; what the controller is like (the lowest level that it may fly, the tilt law of its references, how it is built)
//! is asked of the controller's type, a [`ControlLaw`]. A new law is a row here and a controller.

use crate::any::InCharge;
use crate::controller::{Controller, ControllerError};
use crate::pid::{Pid, PidSettings};
use crate::{C1, C2, C3, Settings, TiltLaw};
use quad_dynamics::{CommandLimits, Level, LevelModel, Vehicle, WithLevel};
use quad_math::Real;
use serde::{Deserialize, Serialize};
use std::fmt;

/// What loops are asked to achieve, in the terms of every kind of law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopDesign {
    /// Of the inversions.
    pub inversion: Settings,
    /// Of the PID cascade.
    pub pid: PidSettings,
}

/// A controller that is a law of the table.
pub trait ControlLaw<R: Real>: Controller<R> + Copy + fmt::Debug + Send + Sync + 'static {
    /// How its references turn accelerations into tilt: as the model that it inverts does.
    const TILT_LAW: TiltLaw;

    /// Whether it inverts the model of its lowest level, and so belongs to that level and those above.
    const INVERTS: bool;

    /// The controller of a vehicle, without limits on its commands.
    ///
    /// # Errors
    /// A wrong setting; a singular control matrix.
    fn design(vehicle: &Vehicle, design: &LoopDesign) -> Result<Self, ControllerError>;

    /// The same controller with limits on its commands, or without.
    #[must_use]
    fn with_limits(self, limits: Option<CommandLimits<R>>) -> Self;

    /// The controller as one whose law is known at run time only.
    fn any(in_charge: InCharge<R, Self>) -> AnyController<R>;
}

/// What to do with the controller of a law that is known at run time only: a closure that is generic in a type.
pub trait WithLaw<R: Real> {
    /// What comes of it.
    type Out;

    /// Does it.
    fn with<C: ControlLaw<R>>(self) -> Self::Out;
}

/// What to do with the model of a level and the inversion that belongs to it, known at run time only.
pub trait WithPaired<R: Real> {
    /// What comes of it.
    type Out;

    /// Does it.
    fn with<M: LevelModel<R>, C: ControlLaw<R>>(self) -> Self::Out;
}

/// A visitor of pairs as one of levels.
struct Paired<V>(V);

/// Makes everything that lists the laws, so that none can be forgotten. The leading `$` is passed in for the macro inside.
macro_rules! laws {
    ($d:tt $($(#[doc = $doc:literal])+ $law:ident = $name:literal: $controller:ident,)+) => {
        /// A control law. In files: its name.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
        pub enum Law {
            $($(#[doc = $doc])+ #[serde(rename = $name)] $law,)+
        }

        impl Law {
            /// All laws, in the order of the table.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$law),+];

            /// The name in files and legends.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$law => $name,)+
                }
            }

            /// What it is, in a sentence.
            pub fn summary(self) -> &'static str {
                match self {
                    $(Self::$law => concat!($($doc),+).trim_start(),)+
                }
            }

            /// The lowest level that it may fly.
            pub const fn lowest_level(self) -> Level {
                match self {
                    $(Self::$law => <$controller<f64> as Controller<f64>>::LEVEL,)+
                }
            }

            /// How its references turn accelerations into tilt.
            pub const fn tilt_law(self) -> TiltLaw {
                match self {
                    $(Self::$law => <$controller<f64> as ControlLaw<f64>>::TILT_LAW,)+
                }
            }

            /// Whether it inverts the model of its lowest level.
            pub const fn inverts(self) -> bool {
                match self {
                    $(Self::$law => <$controller<f64> as ControlLaw<f64>>::INVERTS,)+
                }
            }

            /// Does something with the law's controller.
            pub fn visit<R: Real, V: WithLaw<R>>(self, visitor: V) -> V::Out {
                match self {
                    $(Self::$law => visitor.with::<$controller<R>>(),)+
                }
            }
        }

        /// One of the controllers, by value: controller and memory in one, so that they can't be mismatched.
        #[derive(Clone, Debug)]
        pub enum AnyController<R: Real> {
            $($(#[doc = $doc])+ $law(InCharge<R, $controller<R>>),)+
        }

        impl<R: Real, V: WithPaired<R>> WithLevel<R> for Paired<V> {
            type Out = V::Out;

            fn with<M: LevelModel<R>>(self) -> V::Out {
                // Decided when the program is built, so that a level is compiled with its own law only.
                $(if const { matches!(Law::paired(M::LEVEL), Law::$law) } {
                    return self.0.with::<M, $controller<R>>();
                })+
                unreachable!("every law is in the table")
            }
        }

        /// The same expression for whichever controller is inside.
        macro_rules! each_controller {
            ($d any:expr, $d inner:ident => $d body:expr) => {
                match $d any {
                    $($crate::AnyController::$law($d inner) => $d body,)+
                }
            };
        }
    };
}

laws! { $
    /// Dynamic inversion of level 1, for models of any level.
    C1 = "c1": C1,
    /// Dynamic inversion of level 2, for level 2 and above.
    C2 = "c2": C2,
    /// Dynamic inversion of level 3, for level 3 and above.
    C3 = "c3": C3,
    /// Conventional cascaded PID, for any level.
    Pid = "pid": Pid,
}

/// A vehicle's controller of any law.
struct Build<'a> {
    vehicle: &'a Vehicle,
    design: &'a LoopDesign,
}

impl<R: Real> WithLaw<R> for Build<'_> {
    type Out = Result<AnyController<R>, ControllerError>;

    fn with<C: ControlLaw<R>>(self) -> Self::Out {
        Ok(C::any(C::design(self.vehicle, self.design)?.into()))
    }
}

impl Law {
    /// The inversion that belongs to a level: of those that may fly it, the one that knows most.
    pub const fn paired(level: Level) -> Self {
        let mut paired = Self::ALL[0];
        let mut i = 1;
        while i < Self::ALL.len() {
            let law = Self::ALL[i];
            let lowest = law.lowest_level().number();
            let knows_more = lowest > paired.lowest_level().number();
            if law.inverts() && lowest <= level.number() && knows_more {
                paired = law;
            }
            i += 1;
        }
        paired
    }

    /// The controller of a vehicle, without limits on its commands.
    ///
    /// # Errors
    /// A wrong setting; a singular control matrix.
    pub fn build<R: Real>(
        self,
        vehicle: &Vehicle,
        design: &LoopDesign,
    ) -> Result<AnyController<R>, ControllerError> {
        self.visit::<R, _>(Build { vehicle, design })
    }

    /// Does something with the model of a level and the inversion that belongs to it.
    pub fn visit_paired<R: Real, V: WithPaired<R>>(level: Level, visitor: V) -> V::Out {
        level.visit::<R, _>(Paired(visitor))
    }
}

impl fmt::Display for Law {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::de::value::StrDeserializer;

    /// Thesis chapter 6.3: c1, c2 and c3 invert levels 1, 2 and 3; chapter 6.5 flies c3 on those above, too.
    #[test]
    fn thesis_inversions_belong_to_levels() {
        let paired = [Law::C1, Law::C2, Law::C3, Law::C3, Law::C3];
        assert_eq!(Level::ALL.map(Law::paired), paired);
        for law in Law::ALL {
            let is_small = law.tilt_law() == TiltLaw::SmallAngle;
            assert_eq!(is_small, law == Law::C1, "{law}");
        }
    }

    /// The type behind a pair is the type behind its level and its law.
    #[test]
    fn exact_pairs_are_of_the_level_and_its_law() {
        struct Levels;
        impl WithPaired<f64> for Levels {
            type Out = (Level, Level);
            fn with<M: LevelModel<f64>, C: ControlLaw<f64>>(self) -> (Level, Level) {
                (M::LEVEL, C::LEVEL)
            }
        }
        for level in Level::ALL {
            let expected = (level, Law::paired(level).lowest_level());
            assert_eq!(Law::visit_paired::<f64, _>(level, Levels), expected);
        }
    }

    /// A name in a file is the law of that name.
    #[test]
    fn exact_names_round_trip() {
        for law in Law::ALL {
            let file = StrDeserializer::<serde::de::value::Error>::new(law.name());
            assert_eq!(Law::deserialize(file).unwrap(), law);
            assert!(law.summary().ends_with('.') && !law.summary().starts_with(' '));
        }
    }
}
