//! Trajectories for wireless power transmission: the problem, its rollouts and its optimisers.

pub mod optimisers;
