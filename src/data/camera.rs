//! Cameras and lights in the world: right-handed, y up, lengths in units of the mesh.

use std::f64::consts::TAU;

use glam::{DMat4, DQuat, DVec3, DVec4, dcamera::rh, dvec3};

use super::Mesh;

/// How a camera projects.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Through a point.
    Perspective {
        /// Angle between the picture's upper and lower edge, radians.
        field_of_view: f64,
    },
    /// Along parallel rays.
    Orthographic {
        /// Height of the picture in the world.
        height: f64,
    },
}

/// A camera in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Where it stands.
    pub eye: DVec3,
    /// What is in the middle of the picture.
    pub target: DVec3,
    /// What is up in the picture, as far as it is across the view.
    pub up: DVec3,
    /// How it projects.
    pub projection: Projection,
    /// Distances from the eye's plane between which something is seen.
    pub depths: [f64; 2],
    /// Columns and rows of the picture.
    pub size: [u32; 2],
}

/// A rectangle of a picture, in pixels from its upper left corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// Left and upper edge.
    pub corner: [f64; 2],
    /// Columns and rows.
    pub size: [f64; 2],
}

impl Projection {
    /// With `degrees` between the picture's upper and lower edge; 0 is parallel rays, with a picture `height` high in the world.
    #[must_use]
    pub fn by_angle(degrees: f64, height: f64) -> Self {
        if degrees == 0.0 { Self::Orthographic { height } } else { Self::Perspective { field_of_view: degrees.to_radians() } }
    }
}

impl Camera {
    /// Radii of a mesh's ball between which depths lie: its relief may stand out of it.
    pub const ROOM: f64 = 1.05;

    /// A camera that sees all of `mesh` from `bearing`, azimuth and elevation in degrees as of [`Self::around`], `angle` degrees between the
    /// upper and the lower edge, 0 for parallel rays: as near as it can be with a twentieth of the picture left free around it. With `turning`
    /// the mesh may turn about the vertical axis through its middle.
    #[must_use]
    pub fn showing(mesh: &Mesh, bearing: [f64; 2], angle: f64, size: [u32; 2], turning: bool) -> Self {
        /// Directions that stand for a whole turn.
        const TURNS: u32 = 32;
        const MARGIN: f64 = 0.05;
        let (center, radius) = mesh.ball();
        let camera = Self::around(center, radius, bearing.map(f64::to_radians), Projection::by_angle(angle, 2.0 * radius), size);
        let toward = camera.toward();
        let right = camera.up.cross(toward).normalize();
        let up = toward.cross(right);
        // Half of the picture's width, of its height 1.
        let aspect = f64::from(size[0]) / f64::from(size[1]);
        let turns = if turning { TURNS } else { 1 };
        let places = (0..turns).flat_map(|turn| {
            let turn = DQuat::from_rotation_y(f64::from(turn) / f64::from(turns) * TAU);
            mesh.positions().iter().map(move |&place| turn * (DVec3::from_array(place.map(f64::from)) - center))
        });
        let reach = |place: DVec3| (place.dot(right).abs() / aspect).max(place.dot(up).abs()) * (1.0 + MARGIN);
        match camera.projection {
            Projection::Perspective { field_of_view } => {
                let half = (0.5 * field_of_view).tan();
                let distance = places.map(|place| place.dot(toward) + reach(place) / half).fold(0.0, f64::max).max(1e-3 * radius);
                Self { eye: center + distance * toward, depths: Self::depths_of(distance, radius), ..camera }
            }
            Projection::Orthographic { .. } => {
                let height = 2.0 * places.map(reach).fold(0.0, f64::max);
                Self { projection: Projection::Orthographic { height }, ..camera }
            }
        }
    }

    /// Whether a ball, of this center and radius, lies beyond the near plane.
    #[must_use]
    pub fn is_before(&self, (center, radius): (DVec3, f64)) -> bool {
        self.toward().dot(self.eye - center) - radius >= self.depths[0]
    }

    /// All of the picture.
    #[must_use]
    pub fn whole(&self) -> Window {
        Window { corner: [0.0; 2], size: self.size.map(f64::from) }
    }

    /// A camera of `projection` that sees a ball of `radius` around `target` from (`azimuth`, `elevation`), radians: azimuth from +z to
    /// the right, elevation towards +y. A perspective camera stands as near as it can and still see the ball whole; the height of an
    /// orthographic one is the ball's.
    #[must_use]
    pub fn around(target: DVec3, radius: f64, [azimuth, elevation]: [f64; 2], projection: Projection, size: [u32; 2]) -> Self {
        let toward = Self::bearing([azimuth, elevation]);
        let narrow = (f64::from(size[0]) / f64::from(size[1])).min(1.0);
        let (distance, projection) = match projection {
            Projection::Perspective { field_of_view } => {
                // Half of the angle across the picture's narrower side.
                let half = (narrow * (0.5 * field_of_view).tan()).atan();
                (radius / half.sin(), projection)
            }
            Projection::Orthographic { .. } => (2.0 * radius, Projection::Orthographic { height: 2.0 * radius / narrow }),
        };
        // At the poles any direction is up that is not the view.
        let up = if elevation.cos().abs() < 1e-6 { dvec3(-azimuth.sin(), 0.0, -azimuth.cos()) * elevation.signum() } else { DVec3::Y };
        Self { eye: target + distance * toward, target, up, projection, depths: Self::depths_of(distance, radius), size }
    }

    /// Depths that a ball of `radius` needs, `distance` from the eye to its middle.
    fn depths_of(distance: f64, radius: f64) -> [f64; 2] {
        [(distance - Self::ROOM * radius).max(1e-3 * distance), distance + Self::ROOM * radius]
    }

    /// Unit vector towards (`azimuth`, `elevation`), radians: azimuth from +z to the right, elevation towards +y.
    #[must_use]
    pub fn bearing([azimuth, elevation]: [f64; 2]) -> DVec3 {
        dvec3(azimuth.sin() * elevation.cos(), elevation.sin(), azimuth.cos() * elevation.cos())
    }

    /// Unit vector from the target to the eye.
    #[must_use]
    pub fn toward(&self) -> DVec3 {
        (self.eye - self.target).normalize()
    }

    /// The eye's place (w = 1), or the direction towards a camera of parallel rays (w = 0).
    #[must_use]
    pub fn homogeneous_eye(&self) -> DVec4 {
        match self.projection {
            Projection::Perspective { .. } => self.eye.extend(1.0),
            Projection::Orthographic { .. } => self.toward().extend(0.0),
        }
    }

    /// From the world to the clip coordinates of WebGPU of a part of the picture: x and y from -1 to 1 across `window`, depth from 0 to 1.
    #[must_use]
    pub fn clip_from_world(&self, window: Window) -> DMat4 {
        let view = rh::view::look_at_mat4(self.eye, self.target, self.up);
        let [width, height] = self.size.map(f64::from);
        let [near, far] = self.depths;
        let projection = match self.projection {
            Projection::Perspective { field_of_view } => rh::proj::directx::perspective(field_of_view, width / height, near, far),
            Projection::Orthographic { height: high } => {
                let (x, y) = (0.5 * high * width / height, 0.5 * high);
                rh::proj::directx::orthographic(-x, x, -y, y, near, far)
            }
        };
        // From clip coordinates of the picture to those of the window.
        let scale = dvec3(width / window.size[0], height / window.size[1], 1.0);
        let middle = [0, 1].map(|axis| (window.corner[axis] + 0.5 * window.size[axis]) / [width, height][axis]);
        let shift = dvec3(scale.x * (1.0 - 2.0 * middle[0]), scale.y * (2.0 * middle[1] - 1.0), 0.0);
        DMat4::from_translation(shift) * DMat4::from_scale(scale) * projection * view
    }

    /// The ray of a place in the picture, in pixels: its origin and direction, away from the camera.
    #[must_use]
    pub fn ray(&self, [column, row]: [f64; 2]) -> [DVec3; 2] {
        let forward = -self.toward();
        let right = forward.cross(self.up).normalize();
        let up = right.cross(forward);
        let [width, height] = self.size.map(f64::from);
        let (x, y) = ((2.0 * column - width) / height, 1.0 - 2.0 * row / height);
        match self.projection {
            Projection::Perspective { field_of_view } => {
                let half = (0.5 * field_of_view).tan();
                [self.eye, (forward + half * (x * right + y * up)).normalize()]
            }
            Projection::Orthographic { height } => [self.eye + 0.5 * height * (x * right + y * up), forward],
        }
    }
}

/// A light in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Light {
    /// Far away.
    Directional {
        /// Unit vector towards it.
        toward: DVec3,
        /// Irradiance on a surface that faces it, R, G, B: under 1 a white Lambertian surface reads 1.
        irradiance: [f64; 3],
    },
    /// At a place.
    Point {
        /// Where.
        place: DVec3,
        /// Irradiance at distance 1 on a surface that faces it; it falls by the square of the distance.
        irradiance: [f64; 3],
    },
}

/// A part of a light's surroundings, as its shadow map sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShadowView {
    /// What it sees, as wide as high.
    pub camera: Camera,
    /// The side of a cube around the light's place that it looks through, 0 to 5 for +x, -x, +y, -y, +z, -z; none if it sees all that the
    /// light shines on.
    pub side: Option<u32>,
    /// Width and height of the picture at distance 1 of a light at a place, anywhere of one far away.
    pub width: f64,
}

impl Light {
    /// A light far away, at azimuth and elevation in degrees as of [`Camera::around`].
    #[must_use]
    pub fn sun(bearing: [f64; 2], irradiance: [f64; 3]) -> Self {
        Self::Directional { toward: Camera::bearing(bearing.map(f64::to_radians)), irradiance }
    }

    /// A light from the upper left and a weak one from the right, so that no side is without any.
    #[must_use]
    pub fn pair() -> Vec<Self> {
        vec![Self::sun([-40.0, 50.0], [1.0; 3]), Self::sun([70.0, 15.0], [0.25; 3])]
    }

    /// The same, turned about the origin.
    #[must_use]
    pub fn turned(&self, turn: DQuat) -> Self {
        match *self {
            Self::Directional { toward, irradiance } => Self::Directional { toward: turn * toward, irradiance },
            Self::Point { place, irradiance } => Self::Point { place: turn * place, irradiance },
        }
    }

    /// The same with `factor` times the irradiance.
    #[must_use]
    pub fn brighter(&self, factor: f64) -> Self {
        let scaled = |irradiance: [f64; 3]| irradiance.map(|value| value * factor);
        match *self {
            Self::Directional { toward, irradiance } => Self::Directional { toward, irradiance: scaled(irradiance) },
            Self::Point { place, irradiance } => Self::Point { place, irradiance: scaled(irradiance) },
        }
    }

    /// What the maps have to show of a ball, `side` texels across each: all of it in one, or, from a place in the ball or near it, through the
    /// sides of a cube.
    #[must_use]
    pub fn shadow_views(&self, center: DVec3, radius: f64, side: u32) -> Vec<ShadowView> {
        let size = [side; 2];
        match *self {
            Self::Directional { toward, .. } => {
                let projection = Projection::Orthographic { height: 2.0 * radius };
                let depths = [(2.0 - Camera::ROOM) * radius, (2.0 + Camera::ROOM) * radius];
                let camera = Camera {
                    eye: center + 2.0 * radius * toward,
                    target: center,
                    up: toward.any_orthogonal_vector(),
                    projection,
                    depths,
                    size,
                };
                vec![ShadowView { camera, side: None, width: 2.0 * radius }]
            }
            Self::Point { place, .. } => {
                let distance = place.distance(center);
                if distance > 1.2 * radius {
                    let half = (radius / distance).asin();
                    let projection = Projection::Perspective { field_of_view: 2.0 * half };
                    let depths = [distance - Camera::ROOM * radius, distance + Camera::ROOM * radius];
                    let up = (center - place).any_orthogonal_vector();
                    let camera = Camera { eye: place, target: center, up, projection, depths, size };
                    return vec![ShadowView { camera, side: None, width: 2.0 * half.tan() }];
                }
                // A few texels more than a right angle: averages at an edge reach beyond it.
                let half = 1.0 + 16.0 / f64::from(side);
                let projection = Projection::Perspective { field_of_view: 2.0 * half.atan() };
                let depths = [1e-3 * radius, distance + Camera::ROOM * radius];
                [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z]
                    .into_iter()
                    .zip(0..)
                    .map(|(forward, number)| {
                        let up = forward.any_orthogonal_vector();
                        let camera = Camera { eye: place, target: place + forward, up, projection, depths, size };
                        ShadowView { camera, side: Some(number), width: 2.0 * half }
                    })
                    .collect()
            }
        }
    }
}
