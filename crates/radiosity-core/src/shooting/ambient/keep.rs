//! What was learnt of uniform light, as bytes and back.

use std::io::{self, Write};

use super::{Ambient, Phase, patch_of};
use crate::checkpoint::{Inconsistent, Reader, Record, tags};
use crate::mesh::Mesh;

tags!(Phase { Watching, LeftOut, Completing, Correcting });

impl Record for Ambient {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        self.phase.write(out)?;
        self.rows.write(out)?;
        self.reflected.write(out)?;
        self.sees.write(out)?;
        self.joined.write(out)?;
        self.waiting.write(out)?;
        self.shot.write(out)?;
        self.returned.write(out)
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Inconsistent> {
        let mut ambient = Self {
            phase: Record::read(from)?,
            rows: Record::read(from)?,
            reflected: Record::read(from)?,
            patch_of: Vec::new(),
            sees: Record::read(from)?,
            joined: Record::read(from)?,
            waiting: Record::read(from)?,
            left: 0,
            shot: Record::read(from)?,
            returned: Record::read(from)?,
        };
        ambient.left = ambient.waiting().count();
        Ok(ambient)
    }
}

impl Ambient {
    /// Whether it can be of this mesh.
    pub(in crate::shooting) fn fits(&self, mesh: &Mesh, receivers: usize) -> bool {
        let patches = mesh.patches.len();
        self.rows.len() == receivers
            && self.reflected.len() == receivers
            && self.sees.len() == receivers
            && self.sees.iter().flatten().all(|&patch| (patch as usize) < patches)
            && self.joined.len() == patches
            // Ways lead to smaller numbers, so they end.
            && (0u32..).zip(&self.joined).all(|(patch, &next)| next <= patch)
            && self.waiting.len() == patches
    }

    /// The same, on the mesh that it fits.
    pub(in crate::shooting) fn on(self, mesh: &Mesh) -> Self {
        Self { patch_of: patch_of(mesh), ..self }
    }
}
