//! Embree 3 (Wald, Woop, Benthin, Johnson and Ernst 2014, "Embree: a kernel framework for efficient
//! CPU ray tracing", ACM TOG 33(4)), the competitor of the ray kernel.
//!
//! The library is opened at run time, so that nothing needs it to be built; [`Embree::open`] says
//! whether it is there. Structures and numbers are those of `embree3/rtcore*.h`, version 3.13.

use std::ffi::{CStr, c_char, c_int, c_void};
use std::mem::transmute;
use std::ptr::null;

/// How much work a hierarchy is worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum Quality {
    /// What Embree does unless told.
    Medium = 1,
    /// With spatial splits.
    High = 2,
}

/// A ray and where it ended, as Embree has them.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
pub struct RayHit {
    origin: [f32; 3],
    t_near: f32,
    direction: [f32; 3],
    time: f32,
    /// Infinite; after a query, the distance of the hit.
    pub distance: f32,
    mask: u32,
    id: u32,
    flags: u32,
    normal: [f32; 3],
    uv: [f32; 2],
    /// The triangle; `u32::MAX` where there is none.
    pub triangle: u32,
    geometry: u32,
    instance: u32,
}

impl RayHit {
    /// An endless ray that has not been shot.
    #[must_use]
    pub fn new(origin: [f32; 3], direction: [f32; 3]) -> Self {
        Self {
            origin,
            t_near: 0.0,
            direction,
            time: 0.0,
            distance: f32::INFINITY,
            mask: u32::MAX,
            id: 0,
            flags: 0,
            normal: [0.0; 3],
            uv: [0.0; 2],
            triangle: u32::MAX,
            geometry: u32::MAX,
            instance: u32::MAX,
        }
    }
}

/// The opened library.
pub struct Embree {
    device: *mut c_void,
    calls: Calls,
}

/// A mesh with its hierarchy.
pub struct Mesh<'a> {
    embree: &'a Embree,
    scene: *mut c_void,
}

#[repr(C)]
struct Context {
    flags: c_int,
    filter: *const c_void,
    instance: u32,
}

unsafe extern "C" {
    fn dlopen(name: *const c_char, flags: c_int) -> *mut c_void;
    fn dlsym(library: *mut c_void, name: *const c_char) -> *mut c_void;
}

const RTLD_NOW: c_int = 2;
const GEOMETRY_TRIANGLE: c_int = 0;
const BUFFER_INDEX: c_int = 0;
const BUFFER_VERTEX: c_int = 1;
const FORMAT_UINT3: c_int = 0x5003;
const FORMAT_FLOAT3: c_int = 0x9003;

type NewDevice = unsafe extern "C" fn(*const c_char) -> *mut c_void;
type NewGeometry = unsafe extern "C" fn(*mut c_void, c_int) -> *mut c_void;
type NewBuffer = unsafe extern "C" fn(*mut c_void, c_int, u32, c_int, usize, usize) -> *mut c_void;
type Attach = unsafe extern "C" fn(*mut c_void, *mut c_void) -> u32;
type Intersect = unsafe extern "C" fn(*mut c_void, *mut Context, *mut RayHit);
type New = unsafe extern "C" fn(*mut c_void) -> *mut c_void;
type Act = unsafe extern "C" fn(*mut c_void);
type Set = unsafe extern "C" fn(*mut c_void, c_int);

/// The functions of the library that are used.
struct Calls {
    new_device: NewDevice,
    release_device: Act,
    new_scene: New,
    release_scene: Act,
    set_scene_quality: Set,
    commit_scene: Act,
    new_geometry: NewGeometry,
    release_geometry: Act,
    set_geometry_quality: Set,
    commit_geometry: Act,
    attach_geometry: Attach,
    new_buffer: NewBuffer,
    intersect: Intersect,
}

impl Embree {
    /// Opens the library with `threads` threads for building; `None` where it is not installed.
    #[must_use]
    pub fn open(threads: usize) -> Option<Self> {
        // SAFETY: the name is a C string; loading runs the constructors of a trusted library.
        let library = unsafe { dlopen(c"libembree3.so.3".as_ptr(), RTLD_NOW) };
        if library.is_null() {
            return None;
        }
        let calls = Calls::load(library)?;
        let config = format!("threads={threads}\0");
        // SAFETY: the configuration is a C string that outlives the call.
        let device = unsafe { (calls.new_device)(config.as_ptr().cast()) };
        (!device.is_null()).then_some(Self { device, calls })
    }

    /// Builds the hierarchy over triangles of three corners each.
    #[must_use]
    pub fn build(&self, corners: &[[[f32; 3]; 3]], quality: Quality) -> Mesh<'_> {
        let Calls { new_scene, new_geometry, new_buffer, .. } = self.calls;
        let points = corners.len() * 3;
        // SAFETY: handles come from the library and are passed on to it alone; the buffers that it
        // hands out have room for what is written (Embree pads the last vertex itself).
        unsafe {
            let scene = new_scene(self.device);
            (self.calls.set_scene_quality)(scene, quality as c_int);
            let geometry = new_geometry(self.device, GEOMETRY_TRIANGLE);
            (self.calls.set_geometry_quality)(geometry, quality as c_int);
            let vertices = new_buffer(geometry, BUFFER_VERTEX, 0, FORMAT_FLOAT3, 12, points);
            corners.as_ptr().cast::<f32>().copy_to_nonoverlapping(vertices.cast(), 3 * points);
            let indices = new_buffer(geometry, BUFFER_INDEX, 0, FORMAT_UINT3, 12, corners.len());
            for i in 0..points {
                indices.cast::<u32>().add(i).write(i as u32);
            }
            (self.calls.commit_geometry)(geometry);
            (self.calls.attach_geometry)(scene, geometry);
            (self.calls.release_geometry)(geometry);
            (self.calls.commit_scene)(scene);
            Mesh { embree: self, scene }
        }
    }
}

impl Mesh<'_> {
    /// Shoots a ray.
    #[inline]
    pub fn closest_hit(&self, ray: &mut RayHit) {
        let mut context = Context { flags: 0, filter: null(), instance: u32::MAX };
        // SAFETY: the scene is committed; ray and context have Embree's layout and alignment.
        unsafe { (self.embree.calls.intersect)(self.scene, &raw mut context, ray) }
    }
}

impl Drop for Mesh<'_> {
    fn drop(&mut self) {
        // SAFETY: the handle is released once.
        unsafe { (self.embree.calls.release_scene)(self.scene) }
    }
}

impl Drop for Embree {
    fn drop(&mut self) {
        // SAFETY: the handle is released once; meshes borrow from it and are gone.
        unsafe { (self.calls.release_device)(self.device) }
    }
}

impl Calls {
    fn load(library: *mut c_void) -> Option<Self> {
        let find = |name: &CStr| {
            // SAFETY: the library is open and the name is a C string.
            let symbol = unsafe { dlsym(library, name.as_ptr()) };
            (!symbol.is_null()).then_some(symbol)
        };
        // SAFETY: each symbol is the function of that name in `embree3/rtcore*.h`, and the types
        // are those of its declaration there.
        unsafe {
            Some(Self {
                new_device: transmute::<*mut c_void, NewDevice>(find(c"rtcNewDevice")?),
                release_device: transmute::<*mut c_void, Act>(find(c"rtcReleaseDevice")?),
                new_scene: transmute::<*mut c_void, New>(find(c"rtcNewScene")?),
                release_scene: transmute::<*mut c_void, Act>(find(c"rtcReleaseScene")?),
                set_scene_quality: transmute::<*mut c_void, Set>(find(c"rtcSetSceneBuildQuality")?),
                commit_scene: transmute::<*mut c_void, Act>(find(c"rtcCommitScene")?),
                new_geometry: transmute::<*mut c_void, NewGeometry>(find(c"rtcNewGeometry")?),
                release_geometry: transmute::<*mut c_void, Act>(find(c"rtcReleaseGeometry")?),
                set_geometry_quality: transmute::<*mut c_void, Set>(find(
                    c"rtcSetGeometryBuildQuality",
                )?),
                commit_geometry: transmute::<*mut c_void, Act>(find(c"rtcCommitGeometry")?),
                attach_geometry: transmute::<*mut c_void, Attach>(find(c"rtcAttachGeometry")?),
                new_buffer: transmute::<*mut c_void, NewBuffer>(find(c"rtcSetNewGeometryBuffer")?),
                intersect: transmute::<*mut c_void, Intersect>(find(c"rtcIntersect1")?),
            })
        }
    }
}
