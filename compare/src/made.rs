//! What tests are made of in several places.

use crate::{Method, Model, ModelOptions};

/// The model of a method with usual options.
pub(crate) fn model(method: Method) -> Model {
    Model::set_up(method, &ModelOptions::default()).unwrap()
}

/// Both forms of lubrication theory, which need no table.
pub(crate) fn lubrication() -> [Model; 2] {
    [Method::Lt, Method::LtCorrected].map(model)
}
