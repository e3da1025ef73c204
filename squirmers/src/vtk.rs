//! The flow as XML files of VTK, which ParaView and others open: spheres (`.vtu`), a plane (`.vts`), and the collection of both by time (`.pvd`).
//!
//! Numbers are binary in base64, so that none loses a digit and `NaN` is allowed; VTK's text cannot hold it. The format is that of *VTK File
//! Formats* (Kitware), with headers of 64 bits in the order of little-endian bytes.

use std::fmt::Write as _;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;

use compare::study::flow::{FlowField, SurfaceField};
use scene::nalgebra::Vector3;

/// Code of a triangle.
const TRIANGLE: u8 = 5;

/// A file of a collection.
pub(crate) struct Part {
    /// Time, in `a/V_s`.
    pub t: f64,
    /// Number of the part: 0 the plane, 1 and 2 the squirmers.
    pub number: usize,
    /// Name of the file.
    pub file: String,
}

/// Values of an array, with their number for each point.
fn array(name: &str, kind: &str, components: usize, bytes: &[u8]) -> String {
    let mut block = (bytes.len() as u64).to_le_bytes().to_vec();
    block.extend_from_slice(bytes);
    let text = BASE64_STANDARD.encode(block);
    format!(
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"binary\">{text}</DataArray>\n"
    )
}

fn scalars(name: &str, values: impl Iterator<Item = f64>) -> String {
    let bytes: Vec<u8> = values.flat_map(f64::to_le_bytes).collect();
    array(name, "Float64", 1, &bytes)
}

fn vectors<'a>(name: &str, values: impl Iterator<Item = &'a Vector3<f64>>) -> String {
    let bytes: Vec<u8> = values
        .flat_map(|v| [v.x, v.y, v.z])
        .flat_map(f64::to_le_bytes)
        .collect();
    array(name, "Float64", 3, &bytes)
}

fn whole(name: &str, values: impl Iterator<Item = usize>) -> String {
    let bytes: Vec<u8> = values.flat_map(|v| (v as i64).to_le_bytes()).collect();
    array(name, "Int64", 1, &bytes)
}

fn file(kind: &str, body: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         {body}</VTKFile>\n"
    )
}

/// A sphere: triangles with slip, velocity, traction, and density if there is one, at their corners.
pub(crate) fn surface(surface: &SurfaceField) -> String {
    let (points, cells) = (surface.points.len(), surface.triangles.len());
    let mut data = vectors("slip", surface.slip.iter());
    data += &vectors("surface_velocity", surface.surface_velocity.iter());
    data += &vectors("velocity", surface.velocity.iter());
    data += &vectors("traction", surface.traction.iter());
    if let Some(density) = &surface.density {
        data += &vectors("density", density.iter());
    }
    let types = array("types", "UInt8", 1, &vec![TRIANGLE; cells]);
    let body = format!(
        "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">\n<PointData Vectors=\"velocity\">\n{data}</PointData>\n\
         <Points>\n{}</Points>\n<Cells>\n{}{}{types}</Cells>\n</Piece>\n</UnstructuredGrid>\n",
        vectors("Points", surface.points.iter()),
        whole("connectivity", surface.triangles.iter().flatten().copied()),
        whole("offsets", (1..=cells).map(|cell| 3 * cell)),
    );
    file("UnstructuredGrid", &body)
}

/// The grid of a field: velocity, speed and pressure at its points, and the number of the squirmer that they lie within.
pub(crate) fn plane(field: &FlowField) -> String {
    let last = field.side - 1;
    let extent = format!("0 {last} 0 {last} 0 0");
    let states = || field.points.iter().map(|point| &point.state);
    let mut data = vectors("velocity", states().map(|state| &state.velocity));
    data += &scalars("speed", states().map(|state| state.velocity.norm()));
    data += &scalars("pressure", states().map(|state| state.pressure));
    let inside = field
        .points
        .iter()
        .map(|point| point.inside.map_or(0, |k| k + 1));
    data += &whole("inside", inside);
    let body = format!(
        "<StructuredGrid WholeExtent=\"{extent}\">\n<Piece Extent=\"{extent}\">\n<PointData Vectors=\"velocity\" Scalars=\"speed\">\n{data}\
         </PointData>\n<Points>\n{}</Points>\n</Piece>\n</StructuredGrid>\n",
        vectors("Points", field.points.iter().map(|point| &point.place)),
    );
    file("StructuredGrid", &body)
}

/// The collection of parts at their times.
pub(crate) fn collection(parts: &[Part]) -> String {
    let mut body = "<Collection>\n".to_owned();
    for Part { t, number, file } in parts {
        let _ = writeln!(
            body,
            "<DataSet timestep=\"{t:?}\" part=\"{number}\" file=\"{file}\"/>"
        );
    }
    body += "</Collection>\n";
    file("Collection", &body)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_hold_the_bytes_after_their_number() {
        let text = scalars("pressure", [1.5, f64::NAN].into_iter());
        let data = text.split('>').nth(1).unwrap().split('<').next().unwrap();
        let bytes = BASE64_STANDARD.decode(data).unwrap();
        assert_eq!(bytes[..8], 16_u64.to_le_bytes());
        assert_eq!(bytes[8..16], 1.5_f64.to_le_bytes());
        assert_eq!(bytes.len(), 24);
    }

    #[test]
    fn a_collection_lists_its_files_by_time() {
        let part = |t, number| Part {
            t,
            number,
            file: "flow.vts".to_owned(),
        };
        let text = collection(&[part(0.1, 0), part(0.1 + 0.2, 2)]);
        assert!(text.contains("timestep=\"0.30000000000000004\" part=\"2\" file=\"flow.vts\""));
        assert!(text.starts_with("<?xml") && text.ends_with("</VTKFile>\n"));
    }
}
