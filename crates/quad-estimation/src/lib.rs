//! State estimation with poor sensors on any level's model.
