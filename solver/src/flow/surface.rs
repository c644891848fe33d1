//! Nodes just beyond a free surface, to which points give next to nothing: what
//! [`crate::basis`] does for stored stencils (its `faint` nodes), done to the sums of the nodes.
//!
//! A faint node F gets nothing; what it would get goes to the two nodes before it along an axis, and it
//! moves as they say:
//!
//! ```text
//! s_1 += 2 s_F,   s_2 -= s_F,   s_F = 0            for masses, momenta, forces
//! v_F = 2 v_1 - v_2                                for velocities, accelerations
//! ```
//!
//! The second is the adjoint of the first, so that masses, momenta, linear fields and work are kept,
//! and points need not know. Beyond an edge or a corner the nodes before are faint themselves; such
//! nodes are folded first and follow last.
//!
//! This holds surfaces that are pulled or driven. It is no matter of stability: what a point does to nodes of
//! its own functions is bounded by `omega^2 <= c^2 max sum |grad N|^2/N`, however little they weigh, but
//! folding makes points act on nodes that they do not see, and those have to be firm. In a chain, s_2 may belong to
//! a faint node that has less to spare: a faint node does not lean where another one would be left with less than
//! nothing, or one that is not faint with less than half of its mass. A faint node without nodes to lean on stays
//! as it is, as around single points and in splashes.
//!
//! The ends of the grid are another matter. Wide functions are folded there and linear: points that are all
//! within a share x of a cell from an end give the node next to it a share x of their mass and all of their
//! force, `omega^2 = c^2/(h^2 x)` without bound. Such a light node F sticks to the end's node E,
//!
//! ```text
//! s_E += s_F,   s_F = 0,   v_F = v_E,
//! ```
//!
//! adjoint as well, so that masses, momenta and work are kept, though not linear fields: a film thinner than a
//! tenth of a cell moves as one with the end, and stays where that is held. A node next to an end is faint by such
//! points and not by its distance from a body while it has less than twice that share. It does not lean then: it
//! would hand all of their force, doubled, to a node that may be hardly heavier than itself. Where the end's node is
//! faint as well it sticks to that at once, and goes with it where that leans.

use super::NodeSums;
use crate::grid::Grid;
use crate::tensor::Vector;

/// A node is faint below this share of the mass of a full cell; as in [`crate::basis`].
const FAINT: f64 = 5e-3;

/// A node is firm from this share on: what is folded onto it weighs next to nothing beside that.
const FIRM: f64 = 0.25;

/// What leaning nodes leave to a node that is none, at least, of its mass.
const LEFT: f64 = 0.5;

/// A node next to an end of the grid is light below this share of the end node's mass. What is not light has
/// `omega^2 <= c^2/h^2 (1/LIGHT + 8)` at a side of the plane and with B-splines: `omega dt < 2` up to Courant
/// numbers of 0.47. Lone points reach 0.41 in a corner, 0.37 with GIMP of four points an axis, 0.34 in a corner of
/// space.
const LIGHT: f64 = 0.1;

/// What a node is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// Without mass.
    Void,
    /// Faint, and not to lean on others: what is faint by points close to an end of the grid.
    Apart,
    /// Faint, without nodes to lean on yet.
    Faint,
    /// Faint, and leans on nodes before it in so many turns.
    Leaning(u8),
    /// Not faint.
    Solid,
}

/// A faint node and the way to the nodes before it.
#[derive(Clone, Copy, Debug)]
struct Lean {
    node: u32,
    step: i32,
}

/// The faint nodes of the bodies on a grid.
#[derive(Debug)]
pub struct Surface<const D: usize> {
    grid: Grid<D>,
    faint: f64,
    firm: f64,
    kinds: Vec<Kind>,
    /// What each node would have, with all leans so far (kg).
    left: Vec<f64>,
    /// From each leaning node to the next before it.
    steps: Vec<i32>,
    /// Faint nodes, those nearest to the bodies first.
    leans: Vec<Lean>,
    /// Faint nodes without a lean.
    rest: Vec<u32>,
    /// Nodes next to an end of the grid, and the nodes on it: axis by axis.
    ends: Vec<[u32; 2]>,
    /// Nodes apart that stick to ends which are faint themselves, before those lean.
    before: Vec<[u32; 2]>,
    /// Light nodes and the nodes that they stick to, which may stick to later ones.
    stuck: Vec<[u32; 2]>,
}

impl<const D: usize> Surface<D> {
    /// For bodies whose full cells weigh `cell_mass` (kg), the lightest of them.
    pub fn new(grid: &Grid<D>, cell_mass: f64) -> Self {
        let nodes = grid.node_count();
        let ends = ends(grid);
        Surface {
            grid: grid.clone(),
            faint: FAINT * cell_mass,
            firm: FIRM * cell_mass,
            kinds: vec![Kind::Void; nodes],
            left: vec![0.0; nodes],
            steps: vec![0; nodes],
            leans: Vec::with_capacity(nodes),
            rest: Vec::with_capacity(nodes),
            before: Vec::with_capacity(ends.len()),
            stuck: Vec::with_capacity(ends.len()),
            ends,
        }
    }

    /// Finds the faint nodes by the sums of all bodies and takes from them what they have.
    pub fn fold(&mut self, sums: &mut NodeSums<D>) {
        self.find(&sums.mass);
        for &[node, end] in &self.before {
            let mass = std::mem::replace(&mut sums.mass[node as usize], 0.0);
            sums.mass[end as usize] += mass;
        }
        for lean in self.leans.iter().rev() {
            let [node, one, two] = lean.line();
            let mass = std::mem::replace(&mut sums.mass[node], 0.0);
            sums.mass[one] += 2.0 * mass;
            sums.mass[two] -= mass;
        }
        self.stick(&mut sums.mass);
        self.fold_field(&mut sums.momentum);
        self.fold_field(&mut sums.force);
    }

    /// The same with the same nodes for one field of sums: momenta after a kick.
    pub fn fold_field(&self, sums: &mut [Vector<D>]) {
        give_all(&self.before, sums);
        for lean in self.leans.iter().rev() {
            let [node, one, two] = lean.line();
            let s = std::mem::replace(&mut sums[node], [0.0; D]);
            for i in 0..D {
                sums[one][i] += 2.0 * s[i];
                sums[two][i] -= s[i];
            }
        }
        give_all(&self.stuck, sums);
    }

    /// Lets the faint nodes follow those before them: velocities or accelerations.
    pub fn follow(&self, field: &mut [Vector<D>]) {
        for &[node, end] in self.stuck.iter().rev() {
            field[node as usize] = field[end as usize];
        }
        for lean in &self.leans {
            let [node, one, two] = lean.line();
            field[node] = std::array::from_fn(|i| 2.0 * field[one][i] - field[two][i]);
        }
        for &[node, end] in self.before.iter().rev() {
            field[node as usize] = field[end as usize];
        }
    }

    /// Number of nodes that lean on others.
    pub fn len(&self) -> usize {
        self.leans.len()
    }

    /// Does no node lean on others?
    pub fn is_empty(&self) -> bool {
        self.leans.is_empty()
    }

    fn find(&mut self, mass: &[f64]) {
        self.leans.clear();
        self.rest.clear();
        for (node, (kind, &m)) in self.kinds.iter_mut().zip(mass).enumerate() {
            *kind = if m >= self.faint {
                Kind::Solid
            } else if m > 0.0 {
                self.rest.push(node as u32);
                Kind::Faint
            } else {
                Kind::Void
            };
        }
        self.left.copy_from_slice(mass);
        self.before.clear();
        for &[node, end] in &self.ends {
            let [node, end] = [node as usize, end as usize];
            if self.kinds[node] != Kind::Faint || mass[node] >= 2.0 * LIGHT * mass[end] {
                continue;
            }
            self.kinds[node] = Kind::Apart;
            if self.kinds[end] == Kind::Faint {
                self.left[end] += std::mem::replace(&mut self.left[node], 0.0);
                self.before.push([node as u32, end as u32]);
            }
        }
        self.rest
            .retain(|&node| self.kinds[node as usize] == Kind::Faint);
        for turn in 0..D as u8 {
            let mut rest = std::mem::take(&mut self.rest);
            rest.retain(|&node| match self.lean(node as usize, turn, mass) {
                Some(lean) => !self.take(lean, turn, mass),
                None => true,
            });
            self.rest = rest;
        }
    }

    /// Lets a node lean, unless some other would be left with too little.
    fn take(&mut self, lean: Lean, turn: u8, mass: &[f64]) -> bool {
        let [node, one, two] = lean.line();
        let own = self.left[node];
        let sound = self.give(one, 2.0 * own, mass) & self.give(two, -own, mass);
        if !sound {
            self.give(one, -2.0 * own, mass);
            self.give(two, own, mass);
            return false;
        }
        self.kinds[node] = Kind::Leaning(turn);
        self.steps[node] = lean.step;
        self.leans.push(lean);
        true
    }

    /// Gives a mass to a node and, if it leans, to those before it. Do all have enough then?
    fn give(&mut self, node: usize, by: f64, mass: &[f64]) -> bool {
        self.left[node] += by;
        if !matches!(self.kinds[node], Kind::Leaning(_)) {
            return self.left[node] >= LEFT * mass[node];
        }
        let step = self.steps[node];
        let [_, one, two] = Lean {
            node: node as u32,
            step,
        }
        .line();
        (self.left[node] >= 0.0) & self.give(one, 2.0 * by, mass) & self.give(two, -by, mass)
    }

    /// Finds the light nodes by what they have once faint ones are folded and gives it to the ends: axis by axis,
    /// so that what is light along several sticks to an edge or a corner.
    fn stick(&mut self, mass: &mut [f64]) {
        self.stuck.clear();
        for &[node, end] in &self.ends {
            let m = mass[node as usize];
            if m > 0.0 && m < LIGHT * mass[end as usize] {
                mass[end as usize] += std::mem::replace(&mut mass[node as usize], 0.0);
                self.stuck.push([node, end]);
            }
        }
    }

    /// Two nodes in a row before a faint one that are solid, the second of them firm, or lean since an
    /// earlier turn: along the axis and the way on which the first has most mass.
    fn lean(&self, node: usize, turn: u8, mass: &[f64]) -> Option<Lean> {
        let index = self.grid.lattice(node);
        let holds = |n: usize, least: f64| match self.kinds[n] {
            Kind::Solid => mass[n] >= least,
            Kind::Leaning(since) => since < turn,
            Kind::Void | Kind::Apart | Kind::Faint => false,
        };
        let mut best: Option<(f64, Lean)> = None;
        let mut stride = 1;
        for a in 0..D {
            for up in [false, true] {
                // on an end it may be held along the normal, which it would not be once it followed
                let on_end = index[a] == 0 || index[a] == self.grid.cells[a];
                let room = !on_end
                    && if up {
                        index[a] + 2 <= self.grid.cells[a]
                    } else {
                        index[a] >= 2
                    };
                if !room {
                    continue;
                }
                let step = if up { stride } else { -stride };
                let lean = Lean {
                    node: node as u32,
                    step,
                };
                let [_, one, two] = lean.line();
                if holds(one, self.faint)
                    && holds(two, self.firm)
                    && best.is_none_or(|(m, _)| mass[one] > m)
                {
                    best = Some((mass[one], lean));
                }
            }
            stride *= self.grid.nodes_along(a) as i32;
        }
        best.map(|(_, lean)| lean)
    }
}

/// Gives the sums of nodes to the ends that they stick to.
fn give_all<const D: usize>(stuck: &[[u32; 2]], sums: &mut [Vector<D>]) {
    for &[node, end] in stuck {
        let s = std::mem::replace(&mut sums[node as usize], [0.0; D]);
        for i in 0..D {
            sums[end as usize][i] += s[i];
        }
    }
}

/// The nodes next to the ends of a grid of at least two cells an axis, with those on the ends.
fn ends<const D: usize>(grid: &Grid<D>) -> Vec<[u32; 2]> {
    let mut pairs = Vec::new();
    for a in 0..D {
        let last = grid.cells[a];
        for node in 0..grid.node_count() {
            let mut index = grid.lattice(node);
            for (next, end) in [(1, 0), (last - 1, last)] {
                if index[a] == next {
                    index[a] = end;
                    pairs.push([node as u32, grid.node(index) as u32]);
                    index[a] = next;
                }
            }
        }
    }
    pairs
}

impl Lean {
    /// The node and the two before it.
    #[inline]
    fn line(self) -> [usize; 3] {
        let node = self.node as usize;
        let one = node.wrapping_add_signed(self.step as isize);
        [node, one, one.wrapping_add_signed(self.step as isize)]
    }
}
