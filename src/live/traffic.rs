//! What the traffic does at one instant, in a few numbers: mean, lowest and highest speed, density, flow, lane changes.

use crate::simulation::Simulation;
use serde::Serialize;

/// A vehicle that is slower than this counts as standing, m/s.
const STANDING: f64 = 0.1;

/// The traffic of all lanes together at one instant.
///
/// ```
/// use ringroad::live::traffic::Traffic;
/// use ringroad::scenario::Scenario;
/// use ringroad::simulation::Simulation;
///
/// let simulation = Simulation::new(&Scenario::default())?;
/// let traffic = Traffic::of(&simulation);
/// assert_eq!(traffic.density, 0.05); // 50 vehicles on 1000 m
/// assert_eq!(traffic.vehicles_per_lane, [50]);
/// # Ok::<(), ringroad::error::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Traffic {
    /// Mean speed of all vehicles, m/s.
    pub mean_speed: f64,
    /// Speed of the slowest vehicle, m/s.
    pub lowest_speed: f64,
    /// Speed of the fastest vehicle, m/s.
    pub highest_speed: f64,
    /// Number of vehicles slower than 0.1 m/s.
    pub standing: usize,
    /// Vehicles per metre of road, all lanes together.
    pub density: f64,
    /// Density times mean speed, vehicles per second, all lanes together.
    pub flow: f64,
    /// Lane changes of all vehicles since t = 0.
    pub lane_changes: usize,
    /// Number of vehicles in each lane, lane 1 first.
    pub vehicles_per_lane: Vec<usize>,
}

impl Traffic {
    /// Reads the present state of a simulation. The time it takes grows linearly with the number of vehicles.
    pub fn of(simulation: &Simulation) -> Self {
        let speeds = simulation.speeds();
        let vehicles = speeds.len() as f64;
        let (mut sum, mut lowest, mut highest, mut standing) = (0.0, f64::INFINITY, 0.0_f64, 0);
        for &speed in speeds {
            sum += speed;
            lowest = lowest.min(speed);
            highest = highest.max(speed);
            standing += usize::from(speed < STANDING);
        }
        let mean_speed = sum / vehicles;
        let density = vehicles / simulation.scenario().length;
        Self {
            mean_speed,
            lowest_speed: lowest,
            highest_speed: highest,
            standing,
            density,
            flow: density * mean_speed,
            lane_changes: (0..speeds.len()).map(|j| simulation.lane_changes(j) as usize).sum(),
            vehicles_per_lane: simulation.vehicles_per_lane().to_vec(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::link;

    fn after(link: &str, seconds: f64) -> (Simulation, Traffic) {
        let mut simulation = Simulation::new(&link::parse(link).scenario).unwrap();
        let step = simulation.scenario().steps(seconds);
        simulation.run_to(step);
        let traffic = Traffic::of(&simulation);
        (simulation, traffic)
    }

    #[test]
    fn a_braking_vehicle_stands_and_is_the_slowest() {
        let (simulation, traffic) = after("reaction-time=0.3&action=at%3D5%3A7%3Abrake%3D3", 6.0);
        assert_eq!((simulation.speed(6), traffic.lowest_speed, traffic.standing), (0.0, 0.0, 1));
        assert!(traffic.lowest_speed < traffic.mean_speed && traffic.mean_speed < traffic.highest_speed);
        assert_eq!(traffic.flow, 0.05 * traffic.mean_speed);
    }

    #[test]
    fn vehicles_and_lane_changes_of_all_lanes_are_counted() {
        let (simulation, traffic) = after("vehicles=30&lanes=2&start=one-lane&time-step=0.05", 60.0);
        assert!(traffic.lane_changes > 10);
        assert_eq!(traffic.vehicles_per_lane.iter().sum::<usize>(), 30);
        let in_lane_1 = (0..30).filter(|&j| simulation.lane(j) == 0).count();
        assert_eq!(traffic.vehicles_per_lane[0], in_lane_1);
    }
}
