//! The JSON Schema of the conversation with a process, and of the header of a file.

use schemars::generate::SchemaSettings;
use serde_json::{Value, json};

use super::asked::PairAnswer;
use super::header::Header;
use super::process::{HeaderAnswer, Question};
use super::quantity::Quantity;

/// The text of `docs/judge.schema.json`: what `squirmers` asks a process and what the process may answer, one line each, made from the types that
/// read and write these lines. `$defs` has `Header` too, which a file gives as TOML.
///
/// ```
/// let schema = compare::submission::schema();
/// let names = &schema["$defs"]["PairAnswer"]["properties"]["values"]["propertyNames"]["enum"];
/// assert_eq!(names[0], "X11A");
/// ```
#[must_use]
pub fn schema() -> Value {
    let mut generator = SchemaSettings::draft2020_12().into_generator();
    let lines = [
        generator.subschema_for::<Question>(),
        generator.subschema_for::<HeaderAnswer>(),
        generator.subschema_for::<PairAnswer>(),
    ];
    generator.subschema_for::<Header>();
    let mut schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A line of the conversation of squirmers with a process that answers as a model",
        "description": "docs/JUDGE.md says what the numbers mean. Made by `cargo run -p squirmers-compare --example schema`.",
        "anyOf": lines,
        "$defs": generator.take_definitions(true),
    });
    // Examples in Rust are for readers of the code.
    let all = schema["$defs"].as_object_mut();
    for of_type in all.into_iter().flat_map(|all| all.values_mut()) {
        if let Some(text) = of_type["description"].as_str()
            && let Some((text, _)) = text.split_once("\n\n```")
        {
            of_type["description"] = json!(text);
        }
    }
    let names: Vec<_> = Quantity::all().map(Quantity::name).collect();
    let answer = &mut schema["$defs"]["PairAnswer"]["properties"];
    answer["values"]["propertyNames"] = json!({ "enum": names });
    answer["slip"]["propertyNames"] = json!({ "pattern": "^B[1-8]_[12](x|z|xz)$" });
    for bound in ["minItems", "maxItems"] {
        answer["matrix"][bound] = json!(12);
        answer["matrix"]["items"][bound] = json!(12);
        answer["slip"]["additionalProperties"][bound] = json!(12);
    }
    schema
}
