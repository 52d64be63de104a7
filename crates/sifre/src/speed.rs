//! The mark of methods that exist for speed alone.
//!
//! [`Agent`](crate::Agent), [`Guidance`](crate::Guidance) and [`Pilot`](crate::quadrotor::Pilot) each have a provided method that
//! does two of the others' jobs in one go. The types of this crate override it where one pass is faster; the result is
//! the same bit for bit. Nobody outside can name [`Hook`], so nobody outside has to, or can, override them.

/// An argument that only this crate can make.
#[derive(Clone, Copy, Debug)]
pub struct Hook(pub(crate) ());
