//! `u32` newtypes over the arenas of a scene.

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub u32);

        impl $name {
            /// The id as a slice index.
            #[must_use]
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl From<usize> for $name {
            /// # Panics
            /// Past 2³²−1 entries, more than any scene this workspace can hold in memory.
            fn from(index: usize) -> Self {
                Self(u32::try_from(index).expect("an arena holds fewer than 2^32 entries"))
            }
        }
    };
}

id!(
    /// A vertex of a [`Scene`](crate::Scene).
    VertexId
);
id!(
    /// An input triangle, counted in file order.
    TriangleId
);
id!(
    /// A material of a [`Scene`](crate::Scene).
    MaterialId
);
id!(
    /// A named group: an OBJ group, a glTF node, or the whole .tri file.
    GroupId
);
