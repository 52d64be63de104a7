//! The vehicles that come with the project: the files of `data/vehicles/`, compiled in.

use super::Vehicle;

/// Text of `data/vehicles/qball-x4.toml`: the project's nominal Qball-X4.
pub const QBALL_X4_TOML: &str = include_str!("../../data/vehicles/qball-x4.toml");
/// Text of `data/vehicles/qball-x4-vendor.toml`: the vendor's parameters of the Qball-X4 only.
pub const QBALL_X4_VENDOR_TOML: &str = include_str!("../../data/vehicles/qball-x4-vendor.toml");
/// Text of `data/vehicles/crazyflie.toml`: a 27 g quadrotor on an X layout.
pub const CRAZYFLIE_TOML: &str = include_str!("../../data/vehicles/crazyflie.toml");

impl Vehicle {
    /// The project's nominal Qball-X4, every group present: see [`QBALL_X4_TOML`].
    #[must_use]
    pub fn qball_x4() -> Self {
        read(QBALL_X4_TOML, "data/vehicles/qball-x4.toml")
    }

    /// The Qball-X4 with the vendor's parameters only, without the optional groups: see [`QBALL_X4_VENDOR_TOML`].
    #[must_use]
    pub fn qball_x4_vendor() -> Self {
        read(QBALL_X4_VENDOR_TOML, "data/vehicles/qball-x4-vendor.toml")
    }

    /// The Crazyflie, X layout, every group present: see [`CRAZYFLIE_TOML`].
    #[must_use]
    pub fn crazyflie() -> Self {
        read(CRAZYFLIE_TOML, "data/vehicles/crazyflie.toml")
    }
}

fn read(text: &str, origin: &str) -> Vehicle {
    Vehicle::from_toml_str(text, origin).expect("the tests of this crate read every file that is compiled in")
}
