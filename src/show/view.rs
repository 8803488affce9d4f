//! Projections of space onto the plane of a drawing.

use std::fmt;
use std::str::FromStr;

use super::Point;
use super::segment::{dot, length};

/// A parallel projection: which directions go to the right and up.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// What it is called.
    pub name: String,
    /// The unit vector that goes to the right.
    pub right: Point,
    /// The unit vector that goes up.
    pub up: Point,
    /// Names of the two axes where they are coordinate axes.
    pub axes: Option<[char; 2]>,
}

/// A view that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ViewError;

impl fmt::Display for ViewError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(
            "expected xy, xz, yz, x-y (y downward), or the direction towards the eye as three numbers, such as 1,-2,1",
        )
    }
}

impl std::error::Error for ViewError {}

impl View {
    /// The view of two coordinate axes, 0 to 2.
    pub fn of_axes(right: usize, up: usize) -> View {
        let unit = |axis: usize| std::array::from_fn(|i| if i == axis { 1.0 } else { 0.0 });
        let letters = ['x', 'y', 'z'];
        View {
            name: format!("{}{}", letters[right], letters[up]),
            right: unit(right),
            up: unit(up),
            axes: Some([letters[right], letters[up]]),
        }
    }

    /// The plane with y downward, as in files of drawings: `x-y`.
    pub fn downward() -> View {
        View {
            name: "x-y".into(),
            up: [0.0, -1.0, 0.0],
            ..View::of_axes(0, 1)
        }
    }

    /// Does the second axis go down?
    pub fn is_downward(&self) -> bool {
        self.axes.is_some() && self.up.iter().sum::<f64>() < 0.0
    }

    /// The views of a curve unless others are asked for: the plane, or front, top and side of space.
    pub fn usual(dimension: usize) -> Vec<View> {
        if dimension == 2 {
            vec![View::of_axes(0, 1)]
        } else {
            vec![View::of_axes(0, 1), View::of_axes(0, 2), View::of_axes(1, 2)]
        }
    }

    /// The view from a direction, z going up where it can.
    pub fn from_direction(eye: Point) -> Option<View> {
        let size = length(&eye);
        if !(size.is_finite() && size > 0.0) {
            return None;
        }
        let eye = eye.map(|x| x / size);
        let pole = if eye[2].abs() > 0.999 {
            [0.0, 1.0, 0.0]
        } else {
            [0.0, 0.0, 1.0]
        };
        let right = cross(&pole, &eye);
        let size = length(&right);
        let right = right.map(|x| x / size);
        let up = cross(&eye, &right);
        Some(View {
            name: format!("from ({:.2}, {:.2}, {:.2})", eye[0], eye[1], eye[2]),
            right,
            up,
            axes: None,
        })
    }

    /// Where a point comes to lie.
    pub fn project(&self, point: &Point) -> [f64; 2] {
        [dot(&self.right, point), dot(&self.up, point)]
    }
}

fn cross(a: &Point, b: &Point) -> Point {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

impl FromStr for View {
    type Err = ViewError;
    fn from_str(text: &str) -> Result<View, ViewError> {
        if text == "x-y" {
            return Ok(View::downward());
        }
        let axes: Vec<Option<usize>> = text.chars().map(|c| "xyz".find(c)).collect();
        if let [Some(right), Some(up)] = axes[..]
            && right != up
        {
            return Ok(View::of_axes(right, up));
        }
        let numbers: Vec<f64> = text
            .split(',')
            .map(|word| word.trim().parse().map_err(|_| ViewError))
            .collect::<Result<_, _>>()?;
        let eye: Point = numbers.try_into().map_err(|_| ViewError)?;
        View::from_direction(eye).ok_or(ViewError)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_give_orthonormal_views() {
        for eye in ["1,-2,1", "0,0,1", "0,0,-3", "1,0,0"] {
            let view: View = eye.parse().unwrap();
            assert!((length(&view.right) - 1.0).abs() < 1e-12);
            assert!((length(&view.up) - 1.0).abs() < 1e-12);
            assert!(dot(&view.right, &view.up).abs() < 1e-12);
        }
        assert_eq!("xz".parse::<View>().unwrap().project(&[1.0, 2.0, 3.0]), [1.0, 3.0]);
        let down: View = "x-y".parse().unwrap();
        assert_eq!(
            (down.project(&[1.0, 2.0, 3.0]), down.is_downward()),
            ([1.0, -2.0], true)
        );
        for text in ["", "xx", "xw", "1,2", "0,0,0", "1,2,nan", "1,2,3,4"] {
            assert!(text.parse::<View>().is_err(), "{text}");
        }
    }
}
