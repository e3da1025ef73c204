//! bem
