//! Fields for ParaView, read back: the grid, the vector at each node, the list of times.

use anechoic_reports::fields::{FieldError, pvd, vtu};
use anechoic_solver::record::{Column, Snapshot};
use vtkio::model::{Attribute, CellType, DataSet, UnstructuredGridPiece, Vtk};

/// Three by two nodes; ux counts them, uy is its negative tenth.
fn snapshot() -> Snapshot {
    let column = |name: &str, factor: f64| Column {
        name: name.to_owned(),
        unit: "m".to_owned(),
        values: (0..6).map(|i| factor * f64::from(i)).collect(),
    };
    Snapshot {
        time: 1.5,
        counts: [3, 2, 1],
        origin: [100.0, -20.0, 0.0],
        spacing: [10.0, 20.0, 0.0],
        columns: vec![column("ux", 1.0), column("uy", -0.1)],
    }
}

fn read_back(bytes: &[u8]) -> UnstructuredGridPiece {
    let file = Vtk::parse_xml(bytes).expect("a VTK file");
    let DataSet::UnstructuredGrid { mut pieces, .. } = file.data else {
        panic!("no unstructured grid");
    };
    assert_eq!(pieces.len(), 1);
    pieces
        .remove(0)
        .into_loaded_piece_data(None)
        .expect("whole")
}

#[test]
fn a_field_comes_back_node_by_node() {
    let piece = read_back(&vtu(&snapshot()).expect("written"));
    let points: Vec<f32> = piece.points.into_vec().expect("single precision");
    let places = [
        [100.0, -20.0],
        [110.0, -20.0],
        [120.0, -20.0],
        [100.0, 0.0],
        [110.0, 0.0],
        [120.0, 0.0],
    ];
    let expected: Vec<f32> = places.iter().flat_map(|[x, y]| [*x, *y, 0.0]).collect();
    assert_eq!(points, expected);
    let [Attribute::DataArray(vector)] = piece.data.point.as_slice() else {
        panic!("not one array at the nodes");
    };
    assert_eq!(
        (vector.name.as_str(), vector.num_comp()),
        ("displacement", 3)
    );
    let values: Vec<f32> = vector.data.cast_into().expect("numbers");
    let expected: Vec<f32> = (0..6u8)
        .flat_map(|i| [f32::from(i), (-0.1 * f64::from(i)) as f32, 0.0])
        .collect();
    assert_eq!(values, expected);
    // Two quadrilaterals, counterclockwise.
    assert_eq!(piece.cells.types, [CellType::Quad; 2]);
    let (corners, ends) = piece.cells.cell_verts.into_xml();
    assert_eq!(corners, [0, 1, 4, 3, 1, 2, 5, 4]);
    assert_eq!(ends, [4, 8]);
}

#[test]
fn a_field_in_space_is_made_of_hexahedra() {
    let mut solid = snapshot();
    (solid.counts, solid.spacing[2]) = ([3, 2, 2], 5.0);
    for (column, factor) in solid.columns.iter_mut().zip([1.0, -0.1]) {
        column.values = (0..12).map(|i| factor * f64::from(i)).collect();
    }
    let missing = FieldError::Component {
        name: "uz",
        samples: 12,
    };
    assert_eq!(vtu(&solid), Err(missing));
    let mut depth = solid.columns[0].clone();
    (depth.name, depth.values[7]) = ("uz".to_owned(), 70.0);
    solid.columns.push(depth);
    let piece = read_back(&vtu(&solid).expect("written"));
    let points: Vec<f32> = piece.points.into_vec().expect("single precision");
    assert_eq!(points[..3], [100.0, -20.0, 0.0]);
    assert_eq!(points[33..], [120.0, 0.0, 5.0]);
    let [Attribute::DataArray(vector)] = piece.data.point.as_slice() else {
        panic!("not one array at the nodes");
    };
    let values: Vec<f32> = vector.data.clone().cast_into().expect("numbers");
    assert_eq!(values[21..24], [7.0, (-0.1 * 7.0_f64) as f32, 70.0]);
    assert_eq!(piece.cells.types, [CellType::Hexahedron; 2]);
    // the quadrilateral in front of that behind, both counterclockwise
    let (corners, ends) = piece.cells.cell_verts.into_xml();
    assert_eq!(corners[..8], [0, 1, 4, 3, 6, 7, 10, 9]);
    assert_eq!(ends, [8, 16]);
}

#[test]
fn a_field_of_velocities_is_named_so() {
    let mut flowing = snapshot();
    for (column, name) in flowing.columns.iter_mut().zip(["vx", "vy"]) {
        column.name = name.to_owned();
    }
    let piece = read_back(&vtu(&flowing).expect("written"));
    let [Attribute::DataArray(vector)] = piece.data.point.as_slice() else {
        panic!("not one array at the nodes");
    };
    assert_eq!(vector.name, "velocity");
    let mut pressed = flowing.clone();
    let mut pressure = flowing.columns[0].clone();
    pressure.name = "p".to_owned();
    pressed.columns.push(pressure);
    let piece = read_back(&vtu(&pressed).expect("written"));
    let [Attribute::DataArray(scalar)] = piece.data.cell.as_slice() else {
        panic!("not one array in the cells");
    };
    assert_eq!((scalar.name.as_str(), scalar.num_comp()), ("pressure", 1));
    let values: Vec<f32> = scalar.data.clone().cast_into().expect("numbers");
    // two cells, each with the value at its lower corner
    assert_eq!(values, [0.0, 1.0]);
    flowing.columns.pop();
    let missing = FieldError::Component {
        name: "vy",
        samples: 6,
    };
    assert_eq!(vtu(&flowing), Err(missing));
}

#[test]
fn the_list_names_times_and_files() {
    let list = pvd([(0.5, "fields/000.vtu"), (1.25, "fields/001.vtu")]);
    let lines: Vec<&str> = list.lines().map(str::trim).collect();
    assert_eq!(
        lines,
        [
            "<?xml version=\"1.0\"?>",
            "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">",
            "<Collection>",
            "<DataSet timestep=\"0.5\" part=\"0\" file=\"fields/000.vtu\"/>",
            "<DataSet timestep=\"1.25\" part=\"0\" file=\"fields/001.vtu\"/>",
            "</Collection>",
            "</VTKFile>",
        ]
    );
}

#[test]
fn what_is_no_plane_field_is_refused() {
    let mut line = snapshot();
    line.counts = [6, 1, 1];
    assert_eq!(vtu(&line), Err(FieldError::Shape([6, 1, 1])));
    let mut short = snapshot();
    short.columns[1].values.pop();
    let missing = FieldError::Component {
        name: "uy",
        samples: 6,
    };
    assert_eq!(vtu(&short), Err(missing.clone()));
    short.columns.remove(1);
    assert_eq!(vtu(&short), Err(missing));
}
