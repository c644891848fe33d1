//! Fields for ParaView: a `.vtu` a time (unstructured grid, XML, zlib), and the `.pvd` that lists them.

use anechoic_solver::record::{Column, Snapshot};
use std::fmt::Write;
use thiserror::Error;
use vtkio::model::{
    Attribute, Attributes, ByteOrder, CellType, Cells, DataSet, UnstructuredGridPiece, Version,
    VertexNumbers, Vtk,
};
use vtkio::xml::{self, Compressor};

/// Effort of the compressor, 0..9.
const EFFORT: u32 = 6;

/// Why a field cannot be written.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum FieldError {
    /// Samples do not lie on a plane lattice.
    #[error(
        "the field has {0:?} samples along the axes; at least 2 by 2, and 1 along z, are needed"
    )]
    Shape([usize; 3]),
    /// A component is missing or of another length than the lattice.
    #[error("the field has no component {name} of {samples} samples")]
    Component {
        /// Name of its column.
        name: &'static str,
        /// Needed length.
        samples: usize,
    },
    /// The library refuses to write it.
    #[error("the file cannot be written: {0}")]
    Write(String),
}

/// The field on the nodes of a snapshot's lattice: quadrilaterals in the plane, hexahedra in space, with the
/// vector `displacement` (m) at their corners, or `velocity` (m/s) with the cells' `pressure` (Pa) where they are
/// what it holds, in single precision. Values that are not finite stay so.
pub fn vtu(snapshot: &Snapshot) -> Result<Vec<u8>, FieldError> {
    let [nx, ny, nz] = snapshot.counts;
    if nx < 2 || ny < 2 || nz < 1 {
        return Err(FieldError::Shape(snapshot.counts));
    }
    let solid = nz > 1;
    let flows = snapshot.columns.iter().any(|column| column.name == "vx");
    let (quantity, names) = match flows {
        true => ("velocity", ["vx", "vy", "vz"]),
        false => ("displacement", ["ux", "uy", "uz"]),
    };
    let (x, y) = (
        component(snapshot, names[0])?,
        component(snapshot, names[1])?,
    );
    let z = solid.then(|| component(snapshot, names[2])).transpose()?;
    let place =
        |axis: usize, i: usize| (snapshot.origin[axis] + i as f64 * snapshot.spacing[axis]) as f32;
    let nodes = || (0..nx * ny * nz).map(|n| [n % nx, n / nx % ny, n / nx / ny]);
    let points: Vec<f32> = nodes()
        .flat_map(|at| [0, 1, 2].map(|axis| place(axis, at[axis])))
        .collect();
    let vectors: Vec<f32> = (0..nx * ny * nz)
        .flat_map(|n| {
            let z = z.map_or(0.0, |z| z.values[n]);
            [x.values[n], y.values[n], z].map(|u| u as f32)
        })
        .collect();
    let corners: Vec<u64> = nodes()
        .filter(|[ix, iy, iz]| ix + 1 < nx && iy + 1 < ny && (iz + 1 < nz || !solid))
        .flat_map(|[ix, iy, iz]| {
            let quad = |iz: usize| {
                let first = ((iz * ny + iy) * nx + ix) as u64;
                let above = first + nx as u64;
                [first, first + 1, above + 1, above]
            };
            let behind = solid.then(|| quad(iz + 1));
            quad(iz).into_iter().chain(behind.into_iter().flatten())
        })
        .collect();
    let (kind, ends) = match solid {
        true => (CellType::Hexahedron, 8),
        false => (CellType::Quad, 4),
    };
    let count = corners.len() / ends;
    let pressures = snapshot.columns.iter().find(|column| column.name == "p");
    let scalars = pressures.map(|column| {
        // samples are the cells' lower corners
        let cells = nodes()
            .zip(&column.values)
            .filter(|([ix, iy, iz], _)| ix + 1 < nx && iy + 1 < ny && (iz + 1 < nz || !solid));
        let values: Vec<f32> = cells.map(|(_, p)| *p as f32).collect();
        Attribute::scalars("pressure", 1).with_data(values)
    });
    let piece = UnstructuredGridPiece {
        points: points.into(),
        cells: Cells {
            cell_verts: VertexNumbers::XML {
                connectivity: corners,
                offsets: (1..=count as u64).map(|n| ends as u64 * n).collect(),
            },
            types: vec![kind; count],
        },
        data: Attributes {
            point: vec![Attribute::vectors(quantity).with_data(vectors)],
            cell: scalars.into_iter().collect(),
        },
    };
    let failed = |error: xml::Error| FieldError::Write(error.to_string());
    let file = Vtk {
        version: Version::new_xml(1, 0),
        title: String::new(),
        byte_order: ByteOrder::LittleEndian,
        data: DataSet::inline(piece),
        file_path: None,
    };
    let mut bytes = Vec::new();
    file.try_into_xml_format(Compressor::ZLib, EFFORT)
        .map_err(failed)?
        .write(&mut bytes)
        .map_err(failed)?;
    Ok(bytes)
}

fn component<'a>(snapshot: &'a Snapshot, name: &'static str) -> Result<&'a Column, FieldError> {
    let samples = snapshot.counts.iter().product();
    let column = snapshot.columns.iter().find(|c| c.name == name);
    column
        .filter(|c| c.values.len() == samples)
        .ok_or(FieldError::Component { name, samples })
}

/// The list of files by their time (s); names are relative to it and hold no character that XML
/// reserves.
pub fn pvd<'a>(files: impl IntoIterator<Item = (f64, &'a str)>) -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <Collection>\n",
    );
    for (time, name) in files {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "    <DataSet timestep=\"{time}\" part=\"0\" file=\"{name}\"/>"
        );
    }
    text.push_str("  </Collection>\n</VTKFile>\n");
    text
}
