//! The techniques as switches, and the octrees that are compared.

/// How the leaf that holds a place is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lookup {
    /// Down from the lowest cell that holds the old place and the new.
    Ancestor,
    /// Down from the root.
    Root,
    /// In an array `[i][j][k]` over the cells of the finest level.
    Array,
    /// In a hash table of all cells by level and place, searched by halving the levels.
    Hash,
}

/// The order in which families of eight cells, and the lists of leaves, lie in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// Level by level.
    BreadthFirst,
    /// Parents before children, one child's descendants after the other's.
    DepthFirst,
    /// Parents between their fourth child and their fifth.
    InOrder,
    /// The upper half of the levels, then each subtree below it, each laid out alike (van Emde
    /// Boas; Prokop 1999).
    VanEmdeBoas,
}

/// When a walk ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// At the first triangle found.
    FirstHit,
    /// At the leaf that is entered behind the nearest triangle found so far, at `t_min`.
    Nearest,
    /// Where it leaves the root, with the nearest triangle.
    Never,
}

/// How triangles lie in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Data {
    /// An array of structs, which the leaves list.
    Structs,
    /// A struct of arrays, which the leaves list.
    Arrays,
    /// Copied to the leaves in fours, arrays within structs; tested four at a time.
    Blocks,
}

/// What the build tests before it looks for a separating axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reject {
    /// Nothing: the box's own axes come last.
    Nothing,
    /// Bounds of the triangle against the box: the box's own axes come first.
    Bounds,
    /// The outcode of each vertex in turn (Cohen & Sutherland), by branches.
    Outcodes,
    /// The outcodes of all vertices at once, in lanes.
    WideOutcodes,
}

/// One octree: how it is built and walked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Switches {
    /// Lists in the leaves alone; otherwise what straddles a cell's middle stays in that cell.
    pub leaf_lists: bool,
    /// How the leaf that holds a place is found.
    pub lookup: Lookup,
    /// How cells lie in memory.
    pub layout: Layout,
    /// The segment's bounds are compared with the triangle's first.
    pub boxes: bool,
    /// The walk ends where the segment does, not where its line leaves the root.
    pub end: bool,
    /// When the walk ends otherwise.
    pub stop: Stop,
    /// A triangle's tests end at the first that fails; otherwise all are made.
    pub short_circuit: bool,
    /// Signs are compared as bits; otherwise their products are compared with zero.
    pub signs: bool,
    /// What follows a triangle's first tests is kept apart, as code that rarely runs.
    pub cold: bool,
    /// How triangles lie in memory.
    pub data: Data,
    /// What the build tests first.
    pub reject: Reject,
    /// The build's search for a separating axis ends at the first, with the plane's normal first;
    /// otherwise all axes are tried.
    pub axes_short_circuit: bool,
}

/// An octree with its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Variant {
    /// The name on the command line.
    pub name: &'static str,
    /// What distinguishes it.
    pub switches: Switches,
}

/// What the others differ from in one switch, or two where one needs the other.
const BASE: Switches = Switches {
    leaf_lists: true,
    lookup: Lookup::Ancestor,
    layout: Layout::BreadthFirst,
    boxes: true,
    end: true,
    stop: Stop::FirstHit,
    short_circuit: true,
    signs: true,
    cold: false,
    data: Data::Structs,
    reject: Reject::Bounds,
    axes_short_circuit: true,
};

const fn variant(name: &'static str, switches: Switches) -> Variant {
    Variant { name, switches }
}

/// Every octree.
pub const VARIANTS: [Variant; 23] = [
    variant("base", BASE),
    variant("again", BASE),
    variant("inner-lists", Switches { leaf_lists: false, ..BASE }),
    variant("root", Switches { lookup: Lookup::Root, ..BASE }),
    variant("array", Switches { lookup: Lookup::Array, ..BASE }),
    variant("hash", Switches { lookup: Lookup::Hash, ..BASE }),
    variant("depth-first", Switches { layout: Layout::DepthFirst, ..BASE }),
    variant("in-order", Switches { layout: Layout::InOrder, ..BASE }),
    variant("van-emde-boas", Switches { layout: Layout::VanEmdeBoas, ..BASE }),
    variant("no-boxes", Switches { boxes: false, ..BASE }),
    variant("no-end", Switches { end: false, ..BASE }),
    variant("nearest", Switches { stop: Stop::Nearest, ..BASE }),
    variant("no-t-min", Switches { stop: Stop::Never, ..BASE }),
    variant("eager", Switches { short_circuit: false, ..BASE }),
    variant("products", Switches { signs: false, ..BASE }),
    variant("cold", Switches { cold: true, ..BASE }),
    variant("arrays", Switches { data: Data::Arrays, ..BASE }),
    variant("blocks", Switches { data: Data::Blocks, ..BASE }),
    variant("blocks-no-boxes", Switches { data: Data::Blocks, boxes: false, ..BASE }),
    variant("no-reject", Switches { reject: Reject::Nothing, ..BASE }),
    variant("outcodes", Switches { reject: Reject::WideOutcodes, ..BASE }),
    variant("narrow-outcodes", Switches { reject: Reject::Outcodes, ..BASE }),
    variant("all-axes", Switches { reject: Reject::Nothing, axes_short_circuit: false, ..BASE }),
];

/// What a technique changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// Answers in a given time.
    Questions,
    /// The time of the build.
    Build,
}

/// A technique: an octree with it and the same without.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Technique {
    /// What it is, as in a table.
    pub name: &'static str,
    /// The octree that has it, by name.
    pub on: &'static str,
    /// The octree that has not.
    pub off: &'static str,
    /// What is measured.
    pub effect: Effect,
}

const fn questions(name: &'static str, on: &'static str, off: &'static str) -> Technique {
    Technique { name, on, off, effect: Effect::Questions }
}

const fn build(name: &'static str, on: &'static str, off: &'static str) -> Technique {
    Technique { name, on, off, effect: Effect::Build }
}

/// Every technique, in the order of the table. The first two compare an octree with itself: what
/// they show is noise.
pub const TECHNIQUES: [Technique; 26] = [
    questions("nothing (noise)", "again", "base"),
    build("nothing (noise), build", "again", "base"),
    questions("lists in leaves alone", "base", "inner-lists"),
    build("lists in leaves alone, build", "base", "inner-lists"),
    questions("leaf from the common ancestor, not the root", "base", "root"),
    questions("leaf from an array [i][j][k], not the root", "array", "root"),
    questions("leaf from a hash table, not the root", "hash", "root"),
    build("array [i][j][k], build", "array", "base"),
    build("hash table, build", "hash", "base"),
    questions("layout depth-first, not breadth-first", "depth-first", "base"),
    questions("layout in-order, not breadth-first", "in-order", "base"),
    questions("layout van Emde Boas, not breadth-first", "van-emde-boas", "base"),
    questions("bounding boxes first", "base", "no-boxes"),
    questions("walk ends at the segment's end", "base", "no-end"),
    questions("t_min ends the search for the nearest", "nearest", "no-t-min"),
    questions("first hit ends the walk, not t_min", "base", "nearest"),
    questions("short circuit in the triangle test", "base", "eager"),
    questions("signs, not products", "base", "products"),
    questions("cold code apart", "cold", "base"),
    questions("struct of arrays, not array of structs", "arrays", "base"),
    questions("blocks of four in the leaves, not array of structs", "blocks", "base"),
    questions("bounding boxes first, in blocks", "blocks", "blocks-no-boxes"),
    build("short circuit among the axes", "no-reject", "all-axes"),
    build("the box's axes first (bounds)", "base", "no-reject"),
    build("outcodes in lanes, not by branches", "outcodes", "narrow-outcodes"),
    build("outcodes in lanes, not bounds", "outcodes", "base"),
];
