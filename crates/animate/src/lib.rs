//! Animations of recorded simulations as one self-contained HTML file.
