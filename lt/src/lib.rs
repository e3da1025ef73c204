//! lt
