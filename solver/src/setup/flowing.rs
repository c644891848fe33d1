//! The points that explicit steps move, as they start: velocities, weight and the stress that carries it,
//! rigid bodies.

use crate::basis::on_grid;
use crate::contact::body::RigidBody;
use crate::contact::term::Touch;
use crate::error::SolverError;
use crate::flow::surface::Surface;
use crate::flow::{Carry, Constitution, Dimension, Flow, Space, Start};
use crate::geometry::Geometry;
use crate::linear::Moment;
use crate::material::herschel_bulkley::HerschelBulkley;
use crate::material::linear_elastic::LinearElastic;
use crate::material::strength::Strength;
use crate::material::von_mises::VonMises;
use crate::physics::flowing::Flowing;
use crate::physics::kernel::NodeTerm;
use crate::points::{BLOCK, Points, blocks};
use crate::problem::{BasisKind, PointMode, Problem, Scheme, Transfer};
use crate::tensor::{Matrix, Vector, zero};
use std::ops::Range;

/// Does explicit motion carry the body's points?
pub(super) fn flows<const D: usize>(problem: &Problem<D>) -> bool {
    problem.scheme == Scheme::Explicit && problem.point_mode == PointMode::Moving
}

/// Refuses what only flowing points have.
pub(super) fn check<const D: usize>(problem: &Problem<D>) -> Result<(), SolverError> {
    let flow = &problem.flow;
    flow.strength.check()?;
    let refuse = |field: &str, reason: &str| {
        Err(SolverError::Setup {
            field: field.to_owned(),
            reason: reason.to_owned(),
        })
    };
    if !(0.0..=1.0).contains(&flow.pic_share) {
        return refuse("points.pic_share", "not between 0 and 1");
    }
    let whole = matches!(problem.transfer, Transfer::Keep | Transfer::Pic);
    if flow.pic_share > 0.0 && whole {
        return refuse(
            "points.pic_share",
            "a share of pic goes with points.transfer = \"flip\" or \"affine\"",
        );
    }
    if D == 3 && matches!(flow.strength, Strength::HerschelBulkley(_)) {
        return refuse(
            "material.strength",
            "the rate of shear is that of plane strain",
        );
    }
    if flows(problem) {
        return Ok(());
    }
    let needs = "needs time.scheme = \"explicit\" and points.mode = \"moving\"";
    if flow.strength != Strength::Elastic {
        return refuse("material.strength", needs);
    }
    if !flow.intruders.is_empty() {
        return refuse("body", needs);
    }
    if flow.velocity != [0.0; D] || flow.gravity != 0.0 {
        return refuse("material.velocity_m_s", needs);
    }
    Ok(())
}

/// The flowing points of `ranges` out of `points`, and what drives them.
pub(super) fn flowing<const D: usize>(
    problem: &Problem<D>,
    geometry: &Geometry<D>,
    points: &Points<D>,
    ranges: &[Range<usize>],
    layers: &Points<D>,
) -> Result<Flowing<D>, SolverError>
where
    Space: Dimension<D>,
{
    let at_start = Moment {
        step: 0,
        time_s: 0.0,
    };
    let parts: Result<Vec<Box<dyn Flow<D>>>, SolverError> = ranges
        .iter()
        .map(|range| {
            let start = start(
                problem,
                geometry,
                &points.place[range.clone()],
                points.volume[range.start],
            );
            Space::flow(constitution(problem), start).map_err(|fault| fault.at(at_start))
        })
        .collect();
    let mut gravity = [0.0; D];
    gravity[1] = -problem.flow.gravity;
    let nodes = geometry.grid.node_count();
    let resting = held_at_start(problem, geometry, layers, &gravity)?;
    let cell_mass = problem.material.density * geometry.grid.h.iter().product::<f64>();
    let wide = problem.basis != BasisKind::Linear;
    Ok(Flowing::new(
        parts?,
        nodes,
        wide.then(|| Surface::new(&geometry.grid, cell_mass)),
        gravity,
        problem.flow.update,
        resting,
    ))
}

fn constitution<const D: usize>(problem: &Problem<D>) -> Constitution {
    let elastic = &problem.material;
    match problem.flow.strength {
        Strength::Elastic => Constitution::LinearElastic(LinearElastic::new(elastic)),
        Strength::VonMises { s_u } => Constitution::VonMises(VonMises::new(elastic, s_u)),
        Strength::HerschelBulkley(rate) => {
            Constitution::HerschelBulkley(HerschelBulkley::new(elastic, rate))
        }
    }
}

fn start<const D: usize>(
    problem: &Problem<D>,
    geometry: &Geometry<D>,
    places: &[Vector<D>],
    volume: f64,
) -> Start<D> {
    let stress = problem
        .flow
        .k0
        .map(|_| places.iter().map(|x| geostatic(problem, x)).collect());
    Start {
        grid: geometry.grid.clone(),
        basis: problem.basis,
        per_axis: geometry.per_axis,
        velocities: vec![problem.flow.velocity; places.len()],
        places: places.to_vec(),
        stress,
        volume,
        density: problem.material.density,
        carry: match problem.transfer {
            Transfer::Flip => Carry::Flip {
                pic: problem.flow.pic_share,
            },
            Transfer::Pic => Carry::Flip { pic: 1.0 },
            Transfer::Affine | Transfer::Keep => Carry::Affine {
                pic: problem.flow.pic_share,
            },
        },
        mean_volumes: problem.flow.mean_volumes,
        shared: problem.flow.shared,
    }
}

/// Stress (Pa) that carries the weight of level ground: `-rho g d` along the second axis, K0 times as much
/// across it.
fn geostatic<const D: usize>(problem: &Problem<D>, x: &Vector<D>) -> Matrix<D> {
    let depth = problem.target.upper[1] - x[1];
    let vertical = -problem.material.density * problem.flow.gravity * depth;
    let mut stress = zero::<D>();
    for i in 0..D {
        stress[i][i] = vertical
            * if i == 1 {
                1.0
            } else {
                problem.flow.k0.unwrap_or(0.0)
            };
    }
    stress
}

/// Forces that the layers' own weight and starting stress put on the nodes (N): layers take up increments
/// alone, so these stay. Empty where there are none.
fn held_at_start<const D: usize>(
    problem: &Problem<D>,
    geometry: &Geometry<D>,
    layers: &Points<D>,
    gravity: &Vector<D>,
) -> Result<Vec<Vector<D>>, SolverError> {
    if problem.flow.k0.is_none() || layers.is_empty() {
        return Ok(Vec::new());
    }
    let mut disc = on_grid(problem.basis, &geometry.grid, geometry.per_axis);
    disc.place(&layers.place)
        .map_err(|p| SolverError::LeftGrid {
            step: 0,
            time_s: 0.0,
            place: layers.place[p].to_vec(),
        })?;
    let nodes = geometry.grid.node_count();
    let (mut internal, mut weight) = (vec![[0.0; D]; nodes], vec![[0.0; D]; nodes]);
    let mut stress = [zero::<D>(); BLOCK];
    for block in blocks(0..layers.len()) {
        let n = block.len();
        for (s, x) in stress.iter_mut().zip(&layers.place[block.clone()]) {
            *s = geostatic(problem, x);
        }
        let mass = &layers.mass[block.clone()];
        disc.scatter_vector(block.clone(), mass, &[*gravity; BLOCK][..n], &mut weight);
        let volumes = &layers.volume[block.clone()];
        disc.scatter_stress(block, volumes, &stress[..n], &mut internal);
    }
    for (w, f) in weight.iter_mut().zip(&internal) {
        *w = std::array::from_fn(|i| w[i] - f[i]);
    }
    Ok(weight)
}

/// Rigid bodies as terms, in a frame that moves at `frame` (m/s), beside layers of such points.
///
/// # Errors
/// A body that starts inside the soil, or comes to a layer.
pub(super) fn intruders<const D: usize>(
    problem: &Problem<D>,
    frame: Vector<D>,
    geometry: &Geometry<D>,
    flowing: &Flowing<D>,
    layers: &[Vector<D>],
) -> Result<Vec<Box<dyn NodeTerm<D>>>, SolverError> {
    let reach = match problem.basis {
        BasisKind::Linear => 1.0,
        BasisKind::Gimp => 1.0 + 0.5 / geometry.per_axis as f64,
        BasisKind::Bspline => 1.5,
    };
    let mut terms: Vec<Box<dyn NodeTerm<D>>> = Vec::new();
    for intruder in &problem.flow.intruders {
        intruder.body.shape.check()?;
        let inside = |x: &&Vector<D>| intruder.body.distance(&[x[0], x[1]], 0.0).gap < 0.0;
        if let Some(x) = flowing.places().iter().find(inside) {
            return Err(SolverError::Setup {
                field: intruder.name.clone(),
                reason: format!("the body starts inside the soil, which has a point at {x:?} m"),
            });
        }
        beside_layers(problem, &intruder.name, &intruder.body, frame, layers)?;
        terms.push(Box::new(Touch::new(
            intruder,
            &geometry.grid,
            geometry.per_axis,
            reach,
            problem.material.p_speed(),
            frame,
        )));
    }
    Ok(terms)
}

/// Refuses a body that comes to the resting points `layers` before the end, in a frame that moves at `frame` (m/s):
/// what it does to a layer is not modelled.
fn beside_layers<const D: usize>(
    problem: &Problem<D>,
    name: &str,
    body: &RigidBody,
    frame: Vector<D>,
    layers: &[Vector<D>],
) -> Result<(), SolverError> {
    // a body moves by less than itself between two looks on any way that a grid holds
    const LOOKS: u32 = 100;
    for look in 1..=LOOKS {
        let time = problem.end_time * f64::from(look) / f64::from(LOOKS);
        let inside = |x: &&Vector<D>| {
            let place = [0, 1].map(|a| x[a] + frame[a] * time);
            body.distance(&place, time).gap < 0.0
        };
        if let Some(x) = layers.iter().find(inside) {
            return Err(SolverError::Setup {
                field: name.to_owned(),
                reason: format!(
                    "the body comes to a layer, which has a point at {x:?} m, within {time:.3} s, and layers do not feel bodies; end before (time.end_s), or make the soil wider"
                ),
            });
        }
    }
    Ok(())
}

/// The layers' points alone, and their ranges among themselves.
pub(super) fn without_flowing<const D: usize>(points: &Points<D>, first: usize) -> Points<D> {
    Points {
        place: points.place[first..].to_vec(),
        volume: points.volume[first..].to_vec(),
        mass: points.mass[first..].to_vec(),
        inertia: None,
        motion: None,
    }
}
