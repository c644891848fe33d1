//! The semi-discrete system: points, nodes, regions and terms joined.

use super::kernel::{Constraints, Lumped, NodeTerm, RegionKernel, Trial};
use crate::basis::Discretisation;
use crate::error::SolverError;
use crate::grid::Grid;
use crate::linear::block_matrix::BlockMatrix;
use crate::linear::cg::norm;
use crate::linear::{Equations, LinearSolver, Moment};
use crate::points::{BLOCK, Points, blocks};
use crate::problem::Transfer;
use crate::tensor::{Vector, zero};
use crate::time::{ForceScale, Motion, Rates, System};
use std::ops::Range;

/// A range of points with its kernel.
pub struct Region<const D: usize> {
    /// Its points.
    pub range: Range<usize>,
    /// Does it belong to the body of interest?
    pub in_target: bool,
    /// What its points do.
    pub kernel: Box<dyn RegionKernel<D>>,
}

/// Nodal state.
#[derive(Clone, Debug)]
pub struct Nodes<const D: usize> {
    /// Lumped coefficients.
    pub lumped: Lumped<D>,
    /// Nodes with mass.
    pub active: Vec<bool>,
    /// Sum of the increments (m): the displacement where nodes keep the motion or move little.
    pub u: Vec<Vector<D>>,
    /// Velocity (m/s).
    pub v: Vec<Vector<D>>,
    /// Acceleration (m/s2).
    pub a: Vec<Vector<D>>,
    /// Increment of displacement of the last step (m).
    pub increment: Vec<Vector<D>>,
}

/// Points, nodes, regions and terms.
pub struct Model<const D: usize> {
    /// Background grid.
    pub grid: Grid<D>,
    /// Shape functions.
    pub disc: Box<dyn Discretisation<D>>,
    /// Material points.
    pub points: Points<D>,
    /// Regions of points.
    pub regions: Vec<Region<D>>,
    /// Terms on nodes.
    pub terms: Vec<Box<dyn NodeTerm<D>>>,
    /// Nodal state.
    pub nodes: Nodes<D>,
    /// Do points move?
    pub moving: bool,
    /// Transfer between points and nodes.
    pub transfer: Transfer,
    /// Linear solver.
    pub solver: LinearSolver<D>,
    constraints: Constraints<D>,
    /// Stiffness of the regions whose force is linear in the displacement.
    linear_stiffness: Option<BlockMatrix<D>>,
    effective: BlockMatrix<D>,
    /// Rates of the effective matrix, when it stands.
    effective_rates: Option<Rates>,
    work: Vec<Vector<D>>,
    times: [f64; 2],
    moment: Moment,
    dt: f64,
}

impl<const D: usize> Model<D> {
    /// Joins the parts and assembles what stays constant.
    ///
    /// # Errors
    /// A point outside the grid.
    #[allow(
        clippy::too_many_arguments,
        reason = "the parts of a model, joined in one place"
    )]
    pub fn new(
        grid: Grid<D>,
        mut disc: Box<dyn Discretisation<D>>,
        points: Points<D>,
        mut regions: Vec<Region<D>>,
        mut terms: Vec<Box<dyn NodeTerm<D>>>,
        moving: bool,
        transfer: Transfer,
        solver: LinearSolver<D>,
    ) -> Result<Self, SolverError> {
        let n = grid.node_count();
        let vectors = || vec![[0.0; D]; n];
        let moment = Moment {
            step: 0,
            time_s: 0.0,
        };
        disc.place(&points.place)
            .map_err(|p| left_grid(&points.place[p], moment))?;
        for term in &mut terms {
            term.attach(disc.as_ref())
                .map_err(|x| left_grid(&x, moment))?;
        }
        let damps = terms.iter().any(|t| t.damps());
        let lumped = Lumped {
            mass: vectors(),
            viscous: if damps { vectors() } else { Vec::new() },
        };
        let nodes = Nodes {
            lumped,
            active: vec![false; n],
            u: vectors(),
            v: vectors(),
            a: vectors(),
            increment: vectors(),
        };
        let linear_stiffness = assemble_linear(&mut regions, disc.as_ref(), &points, &nodes.u);
        let effective = BlockMatrix::zeros(disc.pattern());
        let mut model = Model {
            constraints: Constraints::none(n),
            work: vectors(),
            grid,
            disc,
            points,
            regions,
            terms,
            nodes,
            moving,
            transfer,
            solver,
            linear_stiffness,
            effective,
            effective_rates: None,
            times: [0.0; 2],
            moment,
            dt: 0.0,
        };
        model.lump();
        Ok(model)
    }

    /// Gathers masses and damping of the nodes.
    fn lump(&mut self) {
        let lumped = &mut self.nodes.lumped;
        lumped.mass.fill([0.0; D]);
        lumped.viscous.fill([0.0; D]);
        for region in &self.regions {
            region.kernel.lump(self.disc.as_ref(), &self.points, lumped);
        }
        for term in &self.terms {
            term.lump(lumped);
        }
        for (active, mass) in self.nodes.active.iter_mut().zip(&lumped.mass) {
            *active = mass.iter().all(|m| *m > 0.0);
        }
    }

    /// Points to nodes: momentum and mass-weighted acceleration over mass (K25 (15); the affine
    /// transfer adds the points' gradients).
    fn transfer_to_nodes(&mut self) {
        let Some(motion) = &self.points.motion else {
            return;
        };
        let (points, nodes, disc) = (&self.points, &mut self.nodes, &self.disc);
        nodes.v.fill([0.0; D]);
        nodes.a.fill([0.0; D]);
        for block in blocks(0..points.len()) {
            let mass = &points.mass[block.clone()];
            match &motion.gradients {
                Some(l) => {
                    let x = &points.place[block.clone()];
                    for (f, l, out) in [
                        (&motion.v, &l.v, &mut nodes.v),
                        (&motion.a, &l.a, &mut nodes.a),
                    ] {
                        disc.scatter_affine(
                            block.clone(),
                            mass,
                            &f[block.clone()],
                            &l[block.clone()],
                            x,
                            out,
                        );
                    }
                }
                None => {
                    disc.scatter_vector(
                        block.clone(),
                        mass,
                        &motion.v[block.clone()],
                        &mut nodes.v,
                    );
                    disc.scatter_vector(
                        block.clone(),
                        mass,
                        &motion.a[block.clone()],
                        &mut nodes.a,
                    );
                }
            }
        }
        for ((v, a), m) in nodes.v.iter_mut().zip(&mut nodes.a).zip(&nodes.lumped.mass) {
            for i in 0..D {
                if m[i] > 0.0 {
                    v[i] /= m[i];
                    a[i] /= m[i];
                }
            }
        }
    }

    /// Nodes to points: `a' = sum N a'`, `v += dt/2 (a + a')` (K25 (19), (20)), and the same for the
    /// gradients of the affine transfer; `pic` takes the nodes' velocity instead.
    fn transfer_to_points(&mut self) {
        let Some(motion) = &mut self.points.motion else {
            return;
        };
        let (nodes, disc) = (&self.nodes, &self.disc);
        let half = 0.5 * self.dt;
        let (mut vector, mut matrix) = ([[0.0; D]; BLOCK], [zero::<D>(); BLOCK]);
        let count = motion.v.len();
        for block in blocks(0..count) {
            let n = block.len();
            disc.gather(block.clone(), &nodes.a, &mut vector[..n]);
            let (v, a) = (&mut motion.v[block.clone()], &mut motion.a[block.clone()]);
            advance_rate(
                v.as_flattened_mut(),
                a.as_flattened_mut(),
                vector[..n].as_flattened(),
                half,
            );
            if self.transfer == Transfer::Pic {
                disc.gather(block.clone(), &nodes.v, v);
            }
            if let Some(l) = &mut motion.gradients {
                disc.gradient(block.clone(), &nodes.a, &mut matrix[..n]);
                let (v, a) = (&mut l.v[block.clone()], &mut l.a[block]);
                advance_rate(
                    v.as_flattened_mut().as_flattened_mut(),
                    a.as_flattened_mut().as_flattened_mut(),
                    matrix[..n].as_flattened().as_flattened(),
                    half,
                );
            }
        }
    }

    /// Holds unknowns for the step and puts the driven ones on their motion.
    fn constrain(&mut self) {
        let before = std::mem::take(&mut self.constraints.driven);
        self.constraints.clear();
        for (held, active) in self.constraints.held.iter_mut().zip(&self.nodes.active) {
            *held = [!active; D];
        }
        for term in &self.terms {
            term.constrain(self.times, &mut self.constraints);
        }
        let (nodes, constraints) = (&mut self.nodes, &self.constraints);
        for ((held, v), a) in constraints.held.iter().zip(&mut nodes.v).zip(&mut nodes.a) {
            for i in 0..D {
                if held[i] {
                    (v[i], a[i]) = (0.0, 0.0);
                }
            }
        }
        for &(node, i, motion) in &constraints.driven {
            nodes.v[node as usize][i as usize] = motion.velocity[0];
            nodes.a[node as usize][i as usize] = motion.acceleration[0];
        }
        let released: Vec<(usize, usize)> = before
            .iter()
            .map(|&(node, i, _)| (node as usize, i as usize))
            .filter(|&(node, i)| !constraints.held[node][i])
            .collect();
        if self.transfer == Transfer::Keep && !released.is_empty() {
            self.release(&released);
        }
    }

    /// An unknown that is let go takes the acceleration that balances the forces on it.
    fn release(&mut self, released: &[(usize, usize)]) {
        let rest = vec![[0.0; D]; self.nodes.v.len()];
        let v = self.nodes.v.clone();
        let mut residual = rest.clone();
        let end = self.times[1];
        self.times[1] = self.times[0];
        let motion = Motion {
            increment: &rest,
            v: &v,
            a: &rest,
        };
        let balanced = System::residual(self, &motion, &mut residual);
        self.times[1] = end;
        if balanced.is_ok() {
            for &(node, i) in released {
                self.nodes.a[node][i] = residual[node][i] / self.nodes.lumped.mass[node][i];
            }
        }
    }

    /// Elastic energy of the target alone or of everything (J, per metre of thickness in 2D).
    pub fn strain_energy(&self, target_only: bool) -> f64 {
        let regions = self.regions.iter().filter(|r| r.in_target || !target_only);
        regions
            .map(|r| {
                r.kernel
                    .strain_energy(self.disc.as_ref(), &self.points, &self.nodes.u)
            })
            .sum()
    }

    /// Kinetic energy (J) of the target alone or of everything.
    ///
    /// Where nodes keep the motion a point's share is that of its lumped mass.
    pub fn kinetic_energy(&self, target_only: bool) -> f64 {
        let mut energy = 0.0;
        let mut squares = [[0.0; D]; BLOCK];
        let squared: Vec<Vector<D>> = match self.points.motion {
            Some(_) => Vec::new(),
            None => self.nodes.v.iter().map(|v| v.map(|x| x * x)).collect(),
        };
        for region in self.regions.iter().filter(|r| r.in_target || !target_only) {
            for block in blocks(region.range.clone()) {
                let squares = &mut squares[..block.len()];
                match &self.points.motion {
                    Some(motion) => {
                        for (s, v) in squares.iter_mut().zip(&motion.v[block.clone()]) {
                            *s = v.map(|x| x * x);
                        }
                    }
                    None => self.disc.gather(block.clone(), &squared, squares),
                }
                for (s, m) in squares.iter().zip(&self.points.mass[block]) {
                    energy += 0.5 * m * s.iter().sum::<f64>();
                }
            }
        }
        energy
    }

    /// Linear momentum of everything (kg m/s).
    pub fn momentum(&self) -> Vector<D> {
        let mut sum = [0.0; D];
        let mut add = |m: &Vector<D>, v: &Vector<D>| {
            for i in 0..D {
                sum[i] += m[i] * v[i];
            }
        };
        match &self.points.motion {
            Some(motion) => {
                for (m, v) in self.points.mass.iter().zip(&motion.v) {
                    add(&[*m; D], v);
                }
            }
            None => {
                for (m, v) in self.nodes.lumped.mass.iter().zip(&self.nodes.v) {
                    add(m, v);
                }
            }
        }
        sum
    }

    /// Unknowns that are not held.
    pub fn unknowns(&self) -> usize {
        self.constraints
            .held
            .as_flattened()
            .iter()
            .filter(|h| !**h)
            .count()
    }

    fn trial<'a>(&'a self, increment: &'a [Vector<D>]) -> Trial<'a, D> {
        Trial {
            disc: self.disc.as_ref(),
            points: &self.points,
            start: &self.nodes.u,
            increment,
            dt: self.dt,
            moment: self.moment,
        }
    }

    /// Internal force of the trial increment.
    fn internal_force(
        &mut self,
        increment: &[Vector<D>],
        out: &mut [Vector<D>],
    ) -> Result<(), SolverError> {
        match &self.linear_stiffness {
            Some(stiffness) => {
                for ((w, u), d) in self.work.iter_mut().zip(&self.nodes.u).zip(increment) {
                    *w = std::array::from_fn(|i| u[i] + d[i]);
                }
                stiffness.apply(&self.work, out);
            }
            None => out.fill([0.0; D]),
        }
        let mut regions = std::mem::take(&mut self.regions);
        let trial = self.trial(increment);
        let mut result = Ok(());
        for region in regions
            .iter_mut()
            .filter(|r| !r.kernel.is_linear_in_displacement())
        {
            result = result.and_then(|()| region.kernel.force(&trial, out));
        }
        self.regions = regions;
        result
    }

    /// The effective matrix `rates.mass M + rates.viscous C + K` at the trial increment.
    fn assemble(&mut self, rates: Rates, increment: &[Vector<D>]) {
        let mut matrix = BlockMatrix {
            scratch: Vec::new(),
            ..self.take_effective()
        };
        match &self.linear_stiffness {
            Some(stiffness) => matrix.blocks.copy_from_slice(&stiffness.blocks),
            None => matrix.clear(),
        }
        let mut regions = std::mem::take(&mut self.regions);
        let trial = self.trial(increment);
        for region in regions
            .iter_mut()
            .filter(|r| !r.kernel.is_linear_in_displacement())
        {
            region.kernel.tangent(&trial, &mut matrix);
        }
        self.regions = regions;
        matrix.add_diagonal(rates.mass, &self.nodes.lumped.mass);
        if !self.nodes.lumped.viscous.is_empty() {
            matrix.add_diagonal(rates.viscous, &self.nodes.lumped.viscous);
        }
        for term in &self.terms {
            term.tangent(rates.viscous, &self.nodes.active, &mut matrix);
        }
        self.effective = matrix;
        self.effective_rates = Some(rates);
        self.solver.invalidate();
    }

    fn take_effective(&mut self) -> BlockMatrix<D> {
        let pattern = self.effective.pattern.clone();
        let empty = BlockMatrix {
            pattern,
            blocks: Vec::new(),
            scratch: Vec::new(),
        };
        std::mem::replace(&mut self.effective, empty)
    }

    /// Moves points and what is attached to the material; finds the points' nodes anew.
    fn move_points(&mut self) -> Result<(), SolverError> {
        let mut step = [[0.0; D]; BLOCK];
        for block in blocks(0..self.points.len()) {
            let step = &mut step[..block.len()];
            self.disc.gather(block.clone(), &self.nodes.increment, step);
            for (x, s) in self.points.place[block].iter_mut().zip(step) {
                for i in 0..D {
                    x[i] += s[i];
                }
            }
        }
        for term in &mut self.terms {
            term.advance(
                self.disc.as_ref(),
                &self.nodes.increment,
                &self.nodes.active,
            )
            .map_err(|x| left_grid(&x, self.moment))?;
        }
        let places = &self.points.place;
        self.disc
            .place(places)
            .map_err(|p| left_grid(&places[p], self.moment))?;
        self.effective_rates = None;
        Ok(())
    }

    fn check_finite(&self, values: &[Vector<D>], field: &'static str) -> Result<(), SolverError> {
        match values.iter().position(|x| x.iter().any(|v| !v.is_finite())) {
            None => Ok(()),
            Some(node) => Err(SolverError::NonFinite {
                field,
                step: self.moment.step,
                time_s: self.moment.time_s,
                place: self.grid.node_place(node).to_vec(),
            }),
        }
    }
}

impl<const D: usize> System<D> for Model<D> {
    fn begin_step(&mut self, times: [f64; 2], moment: Moment) {
        self.times = times;
        self.dt = times[1] - times[0];
        self.moment = moment;
        if self.moving {
            self.lump();
        }
        self.transfer_to_nodes();
        self.constrain();
    }

    fn is_linear(&self) -> bool {
        !self.moving
    }

    fn moment(&self) -> Moment {
        self.moment
    }

    fn motion(&self) -> Motion<'_, D> {
        Motion {
            increment: &self.nodes.increment,
            v: &self.nodes.v,
            a: &self.nodes.a,
        }
    }

    fn impose(&self, increment: &mut [Vector<D>]) {
        for (d, held) in increment.iter_mut().zip(&self.constraints.held) {
            for i in 0..D {
                if held[i] {
                    d[i] = 0.0;
                }
            }
        }
        for &(node, i, motion) in &self.constraints.driven {
            let mean = 0.5 * (motion.velocity[0] + motion.velocity[1]);
            increment[node as usize][i as usize] = self.dt * mean;
        }
    }

    fn impose_end(&self, v: &mut [Vector<D>], a: &mut [Vector<D>]) {
        for &(node, i, motion) in &self.constraints.driven {
            v[node as usize][i as usize] = motion.velocity[1];
            a[node as usize][i as usize] = motion.acceleration[1];
        }
    }

    fn residual(
        &mut self,
        trial: &Motion<'_, D>,
        out: &mut [Vector<D>],
    ) -> Result<ForceScale, SolverError> {
        self.internal_force(trial.increment, out)?;
        let mut scale = norm(out);
        let (mut inertia, mut large): (f64, f64) = (0.0, 0.0);
        let rate = 4.0 / (self.dt * self.dt);
        for (((f, m), a), d) in out
            .iter_mut()
            .zip(&self.nodes.lumped.mass)
            .zip(trial.a)
            .zip(trial.increment)
        {
            for i in 0..D {
                let force = m[i] * a[i];
                inertia += force * force;
                large += (m[i] * rate * d[i]).powi(2);
                f[i] = -f[i] - force;
            }
        }
        scale = scale.max(inertia.sqrt());
        if !self.nodes.lumped.viscous.is_empty() {
            for ((f, c), v) in out.iter_mut().zip(&self.nodes.lumped.viscous).zip(trial.v) {
                for i in 0..D {
                    f[i] -= c[i] * v[i];
                }
            }
        }
        for term in &self.terms {
            term.force(self.times[1], trial.v, &self.nodes.active, out);
        }
        for (f, held) in out.iter_mut().zip(&self.constraints.held) {
            for i in 0..D {
                if held[i] {
                    f[i] = 0.0;
                }
            }
        }
        self.check_finite(out, "the balance of forces")?;
        Ok(ForceScale {
            largest: scale.max(norm(out)),
            rounding: 8.0 * f64::EPSILON * large.sqrt(),
        })
    }

    fn solve(
        &mut self,
        rates: Rates,
        increment: &[Vector<D>],
        right: &[Vector<D>],
        scale: ForceScale,
        correction: &mut [Vector<D>],
    ) -> Result<(), SolverError> {
        // a moving model's tangent changes with every trial, a frozen one's only with the rates
        if self.moving || self.effective_rates != Some(rates) {
            self.assemble(rates, increment);
        }
        let disc = &self.disc;
        let equations = Equations {
            matrix: &self.effective,
            held: &self.constraints.held,
            b: right,
            scale,
        };
        self.solver.solve(
            &equations,
            || disc.elimination_order(),
            correction,
            self.moment,
        )?;
        self.check_finite(correction, "the displacement")
    }

    fn place_of_largest(&self, field: &[Vector<D>]) -> Vec<f64> {
        let size = |n: &usize| field[*n].iter().map(|x| x.abs()).fold(0.0, f64::max);
        let node = (0..field.len())
            .max_by(|a, b| size(a).total_cmp(&size(b)))
            .unwrap_or(0);
        self.grid.node_place(node).to_vec()
    }

    fn commit(&mut self, end: &Motion<'_, D>) -> Result<(), SolverError> {
        let mut regions = std::mem::take(&mut self.regions);
        let trial = self.trial(end.increment);
        let mut result = Ok(());
        for region in &mut regions {
            result = result.and_then(|()| region.kernel.commit(&trial));
        }
        self.regions = regions;
        result?;
        self.nodes.increment.copy_from_slice(end.increment);
        self.nodes.v.copy_from_slice(end.v);
        self.nodes.a.copy_from_slice(end.a);
        for (u, d) in self.nodes.u.iter_mut().zip(end.increment) {
            for i in 0..D {
                u[i] += d[i];
            }
        }
        self.transfer_to_points();
        if self.moving {
            self.move_points()
        } else {
            Ok(())
        }
    }
}

/// `rate += dt/2 (a + a')`, then `a = a'`.
fn advance_rate(rate: &mut [f64], a: &mut [f64], next: &[f64], half_step: f64) {
    for ((v, a), n) in rate.iter_mut().zip(a).zip(next) {
        *v += half_step * (*a + n);
        *a = *n;
    }
}

fn assemble_linear<const D: usize>(
    regions: &mut [Region<D>],
    disc: &dyn Discretisation<D>,
    points: &Points<D>,
    rest: &[Vector<D>],
) -> Option<BlockMatrix<D>> {
    let moment = Moment {
        step: 0,
        time_s: 0.0,
    };
    let trial = Trial {
        disc,
        points,
        start: rest,
        increment: rest,
        dt: 0.0,
        moment,
    };
    let mut linear = regions
        .iter_mut()
        .filter(|r| r.kernel.is_linear_in_displacement())
        .peekable();
    linear.peek()?;
    let mut matrix = BlockMatrix::zeros(disc.pattern());
    for region in linear {
        region.kernel.tangent(&trial, &mut matrix);
    }
    Some(matrix)
}

fn left_grid<const D: usize>(place: &Vector<D>, moment: Moment) -> SolverError {
    SolverError::LeftGrid {
        step: moment.step,
        time_s: moment.time_s,
        place: place.to_vec(),
    }
}
