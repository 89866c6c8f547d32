//! The C interface of Embree 4, loaded when the program runs, and a scene of one mesh: all that is
//! unsafe.
//!
//! The declarations follow the headers `include/embree4/rtcore_*.h` of Embree 4, whose C interface
//! is stable within the major version.
#![allow(unsafe_code, reason = "a C library is called; no other file of this crate needs it")]

use std::error::Error;
use std::ffi::{c_char, c_int, c_uint, c_void};
use std::fmt;
use std::mem::ManuallyDrop;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicIsize, Ordering};

use super::EmbreeConfig;

/// The environment variable that may name the library's file.
pub const LIBRARY_VARIABLE: &str = "EMBREE_LIBRARY";

/// The names that the system's loader is asked for otherwise.
pub const LIBRARY_NAMES: [&str; 2] = ["libembree4.so.4", "libembree4.so"];

/// One thread, for the build as for the questions.
const DEVICE_OPTIONS: &std::ffi::CStr = c"threads=1";

// From `rtcore_geometry.h`, `rtcore_buffer.h`, `rtcore_common.h` and `rtcore_scene.h`.
const GEOMETRY_TYPE_TRIANGLE: c_int = 0;
const BUFFER_TYPE_INDEX: c_int = 0;
const BUFFER_TYPE_VERTEX: c_int = 1;
const FORMAT_UINT3: c_int = 0x5003;
const FORMAT_FLOAT3: c_int = 0x9003;
const BUILD_QUALITY_MEDIUM: c_int = 1;
const BUILD_QUALITY_HIGH: c_int = 2;
const SCENE_FLAG_ROBUST: c_int = 1 << 2;
const RAY_QUERY_FLAG_COHERENT: c_int = 1 << 16;
const FEATURE_FLAG_ALL: c_uint = 0xffff_ffff;

type Handle = *mut c_void;
type OccludedOne = unsafe extern "C" fn(Handle, *mut Ray, *mut Arguments);
type OccludedPacket<const N: usize> =
    unsafe extern "C" fn(*const Valid<N>, Handle, *mut Packet<N>, *mut Arguments);
type MemoryMonitor = unsafe extern "C" fn(*mut c_void, isize, bool) -> bool;

/// `RTCRay`.
#[repr(C, align(16))]
pub(super) struct Ray {
    pub(super) origin: [f32; 3],
    pub(super) near: f32,
    pub(super) direction: [f32; 3],
    pub(super) time: f32,
    pub(super) far: f32,
    pub(super) mask: u32,
    pub(super) id: u32,
    pub(super) flags: u32,
}

/// `RTCRay4`, `RTCRay8` and `RTCRay16`: the widest alignment serves all.
#[repr(C, align(64))]
pub(super) struct Packet<const N: usize> {
    pub(super) origin: [[f32; N]; 3],
    pub(super) near: [f32; N],
    pub(super) direction: [[f32; N]; 3],
    pub(super) time: [f32; N],
    pub(super) far: [f32; N],
    pub(super) mask: [u32; N],
    pub(super) id: [u32; N],
    pub(super) flags: [u32; N],
}

/// Which lanes of a packet count: −1 for those that do, else 0.
#[repr(C, align(64))]
pub(super) struct Valid<const N: usize>(pub(super) [c_int; N]);

/// `RTCOccludedArguments`, with the member that is there when curves have a minimal width.
#[repr(C)]
pub(super) struct Arguments {
    flags: c_int,
    features: c_uint,
    context: *mut c_void,
    filter: *mut c_void,
    occluded: *mut c_void,
    min_width: f32,
}

/// Embree could not be used.
#[derive(Debug)]
pub enum EmbreeError {
    /// No file was found, or it is not Embree 4; one line a file that was tried.
    Library(Vec<String>),
    /// Embree refused a call: the number of its `RTCError`.
    Refused(i32),
}

impl fmt::Display for EmbreeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Library(tried) => write!(f, "no Embree 4: {}", tried.join("; ")),
            Self::Refused(code) => write!(f, "Embree reports error {code}"),
        }
    }
}

impl Error for EmbreeError {}

/// The functions of Embree that are used, and the library that keeps them in memory.
pub struct EmbreeLibrary {
    new_device: unsafe extern "C" fn(*const c_char) -> Handle,
    release_device: unsafe extern "C" fn(Handle),
    device_error: unsafe extern "C" fn(Handle) -> c_int,
    set_memory_monitor: unsafe extern "C" fn(Handle, MemoryMonitor, *mut c_void),
    new_scene: unsafe extern "C" fn(Handle) -> Handle,
    release_scene: unsafe extern "C" fn(Handle),
    set_scene_flags: unsafe extern "C" fn(Handle, c_int),
    set_scene_quality: unsafe extern "C" fn(Handle, c_int),
    commit_scene: unsafe extern "C" fn(Handle),
    new_geometry: unsafe extern "C" fn(Handle, c_int) -> Handle,
    release_geometry: unsafe extern "C" fn(Handle),
    new_buffer: unsafe extern "C" fn(Handle, c_int, c_uint, c_int, usize, usize) -> *mut c_void,
    commit_geometry: unsafe extern "C" fn(Handle),
    attach_geometry: unsafe extern "C" fn(Handle, Handle) -> c_uint,
    occluded_1: OccludedOne,
    occluded_4: OccludedPacket<4>,
    occluded_8: OccludedPacket<8>,
    occluded_16: OccludedPacket<16>,
    /// Never unloaded: threads of its task scheduler may still run in it when the last device
    /// is gone.
    _library: ManuallyDrop<libloading::Library>,
}

impl EmbreeLibrary {
    /// Loads the file that [`LIBRARY_VARIABLE`] names, else the first of [`LIBRARY_NAMES`].
    ///
    /// # Errors
    /// Says for each file that was tried why it did not serve.
    pub fn load() -> Result<Arc<Self>, EmbreeError> {
        let named = std::env::var_os(LIBRARY_VARIABLE);
        let files = match &named {
            Some(file) => vec![Path::new(file)],
            None => LIBRARY_NAMES.map(Path::new).to_vec(),
        };
        let mut tried = Vec::new();
        for file in files {
            match Self::open(file) {
                Ok(library) => return Ok(Arc::new(library)),
                Err(error) => {
                    // The loader's own words are in the source; they name the file.
                    let reason = error.source().map(ToString::to_string);
                    tried.push(reason.unwrap_or_else(|| format!("{}: {error}", file.display())));
                }
            }
        }
        Err(EmbreeError::Library(tried))
    }

    fn open(file: &Path) -> Result<Self, libloading::Error> {
        // SAFETY: Embree's initialisers only set up its own data.
        let library = unsafe { libloading::Library::new(file)? };
        /// The function of that name, whose type the field it goes to gives.
        macro_rules! function {
            ($name:literal) => {
                // SAFETY: the type is that of the declaration in Embree 4's headers, and the
                // library lives as long as the pointer.
                *unsafe { library.get($name)? }
            };
        }
        Ok(Self {
            new_device: function!(b"rtcNewDevice\0"),
            release_device: function!(b"rtcReleaseDevice\0"),
            device_error: function!(b"rtcGetDeviceError\0"),
            set_memory_monitor: function!(b"rtcSetDeviceMemoryMonitorFunction\0"),
            new_scene: function!(b"rtcNewScene\0"),
            release_scene: function!(b"rtcReleaseScene\0"),
            set_scene_flags: function!(b"rtcSetSceneFlags\0"),
            set_scene_quality: function!(b"rtcSetSceneBuildQuality\0"),
            commit_scene: function!(b"rtcCommitScene\0"),
            new_geometry: function!(b"rtcNewGeometry\0"),
            release_geometry: function!(b"rtcReleaseGeometry\0"),
            new_buffer: function!(b"rtcSetNewGeometryBuffer\0"),
            commit_geometry: function!(b"rtcCommitGeometry\0"),
            attach_geometry: function!(b"rtcAttachGeometry\0"),
            occluded_1: function!(b"rtcOccluded1\0"),
            occluded_4: function!(b"rtcOccluded4\0"),
            occluded_8: function!(b"rtcOccluded8\0"),
            occluded_16: function!(b"rtcOccluded16\0"),
            _library: ManuallyDrop::new(library),
        })
    }
}

impl Arguments {
    /// What is asked of every segment; `coherent` lets a packet be followed as one.
    pub(super) fn new(coherent: bool) -> Self {
        Self {
            flags: if coherent { RAY_QUERY_FLAG_COHERENT } else { 0 },
            features: FEATURE_FLAG_ALL,
            context: std::ptr::null_mut(),
            filter: std::ptr::null_mut(),
            occluded: std::ptr::null_mut(),
            min_width: 0.0,
        }
    }
}

/// A committed scene of one triangle mesh.
pub(super) struct CommittedScene {
    library: Arc<EmbreeLibrary>,
    device: Handle,
    scene: Handle,
    /// What Embree has allocated; boxed, because Embree knows its address.
    bytes: Box<AtomicIsize>,
}

// SAFETY: a committed scene may be asked from any thread (Embree's manual, «Multi-Threading»); it
// is never changed after the build, and only `drop` takes it by `&mut`.
unsafe impl Send for CommittedScene {}
// SAFETY: as for `Send`.
unsafe impl Sync for CommittedScene {}

impl CommittedScene {
    /// Builds the scene on the calling thread; triangles do not share their corners.
    pub(super) fn build(
        library: Arc<EmbreeLibrary>,
        triangles: &[[[f32; 3]; 3]],
        config: &EmbreeConfig,
    ) -> Result<Self, EmbreeError> {
        assert!(triangles.len() < u32::MAX as usize / 3, "vertex indices are 32 bits wide");
        // SAFETY: the options are a C string.
        let device = unsafe { (library.new_device)(DEVICE_OPTIONS.as_ptr()) };
        if device.is_null() {
            // SAFETY: without a device the thread's own error is returned.
            return Err(EmbreeError::Refused(unsafe { (library.device_error)(device) }));
        }
        let bytes = Box::new(AtomicIsize::new(0));
        // SAFETY: the device is alive, and the counter outlives it (see `drop`).
        let scene = unsafe {
            let counter = std::ptr::from_ref::<AtomicIsize>(&bytes).cast_mut().cast();
            (library.set_memory_monitor)(device, count_bytes, counter);
            (library.new_scene)(device)
        };
        let built = Self { library, device, scene, bytes };
        if !scene.is_null() {
            built.fill(triangles, config);
        }
        // SAFETY: the device is alive.
        match unsafe { (built.library.device_error)(device) } {
            0 => Ok(built),
            code => Err(EmbreeError::Refused(code)),
        }
    }

    fn fill(&self, triangles: &[[[f32; 3]; 3]], config: &EmbreeConfig) {
        let (library, scene) = (&*self.library, self.scene);
        let quality = if config.split { BUILD_QUALITY_HIGH } else { BUILD_QUALITY_MEDIUM };
        let flags = if config.robust { SCENE_FLAG_ROBUST } else { 0 };
        let count = triangles.len();
        // SAFETY: device and scene are alive and used by this thread alone. A buffer has room for
        // the items asked for, or is null, and then is not written, where memory is short.
        unsafe {
            (library.set_scene_flags)(scene, flags);
            (library.set_scene_quality)(scene, quality);
            let mesh = (library.new_geometry)(self.device, GEOMETRY_TYPE_TRIANGLE);
            let buffer = |kind, format, items| {
                let stride = size_of::<[f32; 3]>(); // of three indices, too
                (library.new_buffer)(mesh, kind, 0, format, stride, items)
            };
            if count > 0 {
                let vertices = buffer(BUFFER_TYPE_VERTEX, FORMAT_FLOAT3, 3 * count);
                let indices: *mut [u32; 3] = buffer(BUFFER_TYPE_INDEX, FORMAT_UINT3, count).cast();
                if !vertices.is_null() && !indices.is_null() {
                    vertices.cast::<[[f32; 3]; 3]>().copy_from(triangles.as_ptr(), count);
                    for i in 0..count {
                        let first = 3 * i as u32;
                        indices.add(i).write([first, first + 1, first + 2]);
                    }
                }
            }
            (library.commit_geometry)(mesh);
            (library.attach_geometry)(scene, mesh);
            (library.release_geometry)(mesh);
            (library.commit_scene)(scene);
        }
    }

    /// The memory that Embree holds, its copy of the mesh included, in bytes.
    pub(super) fn bytes(&self) -> usize {
        self.bytes.load(Ordering::Relaxed).max(0) as usize
    }

    /// Sets `ray.far` to −∞ if anything blocks.
    #[inline]
    pub(super) fn occluded(&self, ray: &mut Ray, arguments: &mut Arguments) {
        // SAFETY: the scene is committed; ray and arguments have the layout of the headers.
        unsafe { (self.library.occluded_1)(self.scene, ray, arguments) };
    }

    /// The same for four segments.
    pub(super) fn occluded_4(&self, valid: &Valid<4>, rays: &mut Packet<4>, a: &mut Arguments) {
        // SAFETY: the scene is committed; mask, packet and arguments have the layout of the
        // headers and at least their alignment.
        unsafe { (self.library.occluded_4)(valid, self.scene, rays, a) };
    }

    /// The same for eight segments.
    pub(super) fn occluded_8(&self, valid: &Valid<8>, rays: &mut Packet<8>, a: &mut Arguments) {
        // SAFETY: as for four.
        unsafe { (self.library.occluded_8)(valid, self.scene, rays, a) };
    }

    /// The same for sixteen segments.
    pub(super) fn occluded_16(&self, valid: &Valid<16>, rays: &mut Packet<16>, a: &mut Arguments) {
        // SAFETY: as for four.
        unsafe { (self.library.occluded_16)(valid, self.scene, rays, a) };
    }
}

impl Drop for CommittedScene {
    fn drop(&mut self) {
        // SAFETY: both were made by this library, and nobody
        // asks any more. The byte counter is dropped after this.
        unsafe {
            if !self.scene.is_null() {
                (self.library.release_scene)(self.scene);
            }
            (self.library.release_device)(self.device);
        }
    }
}

/// Adds what Embree allocates or frees to the counter it is given.
unsafe extern "C" fn count_bytes(counter: *mut c_void, bytes: isize, _after: bool) -> bool {
    // SAFETY: `CommittedScene::build` hands over an `AtomicIsize` that outlives the device.
    unsafe { &*counter.cast::<AtomicIsize>() }.fetch_add(bytes, Ordering::Relaxed);
    true
}
