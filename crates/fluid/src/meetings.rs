//! Which solid surfaces each particle meets in a sub-step, looked up once for all passes.

use crate::particles::Particles;
use crate::solids::{Meeting, Solids};
use crate::wall::WallTerms;
use rayon::prelude::*;
use std::ops::Range;

/// Particles a list.
const CHUNK: usize = 32;

#[derive(Clone, Debug, Default)]
struct List {
    all: Vec<(Meeting, WallTerms)>,
    /// Where each particle's own end in `all`.
    ends: [u32; CHUNK],
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Meetings(Vec<List>);

impl Meetings {
    /// Finds the surfaces within `support` of each particle.
    pub fn find(&mut self, p: &Particles, solids: &Solids<'_>, support: f32) {
        let chunks = p.len().div_ceil(CHUNK);
        // Lists that are not used at the moment keep their room.
        if self.0.len() < chunks {
            self.0.resize_with(chunks, List::default);
        }
        self.0[..chunks].par_iter_mut().enumerate().for_each(|(c, list)| {
            let chunk = c * CHUNK..((c + 1) * CHUNK).min(p.len());
            list.fill(p, solids, support, chunk);
        });
    }

    /// The surfaces that particle `i` meets, each with the kernel's integrals over what lies behind it.
    #[inline]
    pub fn of(&self, i: usize) -> &[(Meeting, WallTerms)] {
        let (list, k) = (&self.0[i / CHUNK], i % CHUNK);
        let start = if k == 0 { 0 } else { list.ends[k - 1] };
        &list.all[start as usize..list.ends[k] as usize]
    }
}

impl List {
    fn fill(&mut self, p: &Particles, solids: &Solids<'_>, support: f32, chunk: Range<usize>) {
        self.all.clear();
        for (end, i) in self.ends.iter_mut().zip(chunk) {
            if !p.is_image(i) {
                solids.visit(p.position(i), support, |mut m| {
                    let terms = solids.terms(&mut m);
                    self.all.push((m, terms));
                });
            }
            *end = self.all.len() as u32;
        }
    }
}
