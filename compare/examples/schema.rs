//! Prints the JSON Schema of what a process is asked and may answer, `docs/judge.schema.json`.

fn main() {
    println!("{:#}", compare::submission::schema());
}
