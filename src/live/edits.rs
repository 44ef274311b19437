//! Changes of a watched run: actions, parameters, a new start; and what theory would say after a change, before it is made.

use super::Live;
use crate::error::Error;
use crate::scenario::Scenario;
use crate::scenario::action::{Action, Effect, VehicleSelector};
use crate::scenario::parameters::{Field, RoadField, parameter};
use crate::stability::summary::StabilitySummary;

impl Live {
    /// Applies an action now, whatever its time. Of several values set for one parameter at one step the last is kept.
    ///
    /// # Errors
    /// What is wrong with the action; then nothing has changed.
    pub fn act(&mut self, action: Action) -> Result<(), Error> {
        self.simulation.act(action)?;
        self.simulation.forget_replaced();
        self.read_action_steps();
        self.traffic_has_changed();
        Ok(())
    }

    /// Moves the end of the run, s.
    pub fn set_until(&mut self, until: f64) -> Result<(), Error> {
        self.simulation.set_until(until)
    }

    /// The run so far as a scenario of its own, which ends now. Its replay gives the same state.
    pub fn so_far(&self) -> Scenario {
        let mut scenario = self.simulation.scenario().clone();
        // The step in which vehicles touch belongs to the run.
        let steps = self.simulation.step_index() + u64::from(self.simulation.collision().is_some());
        scenario.until = scenario.time_of(steps);
        scenario
    }

    /// The scenario of a new start under the present conditions: values that were set for all drivers on the way become
    /// those of the default driver, and of the actions those at t = 0 and those still to come are kept.
    pub fn settled(&self) -> Scenario {
        let mut scenario = self.simulation.scenario().clone();
        let now = self.simulation.step_index();
        let set_for_all: Vec<_> = (scenario.actions_in_time().into_iter())
            .filter(|&(step, k)| step <= now && scenario.actions[k].vehicles == VehicleSelector::All)
            .flat_map(|(_, k)| scenario.actions[k].effects.clone())
            .filter_map(
                |effect| if let Effect::Set(field, value) = effect { Some((field, value)) } else { None },
            )
            .collect();
        for (field, value) in set_for_all {
            scenario.driver.set(field, value);
            for differing in &mut scenario.overrides {
                differing.values.retain(|(f, _)| *f != field);
            }
        }
        scenario.overrides.retain(|e| !e.values.is_empty());
        let is_set = |e: &Effect| matches!(e, Effect::Set(..));
        let step_of: Vec<u64> = scenario.actions.iter().map(|a| scenario.steps(a.at)).collect();
        let is_settled = |a: &Action| a.vehicles == VehicleSelector::All && a.effects.iter().all(is_set);
        let mut step_of = step_of.into_iter();
        scenario
            .actions
            .retain(|a| step_of.next().is_some_and(|step| step > now || step == 0 && !is_settled(a)));
        scenario
    }

    /// The scenario of a new start ([`Self::settled`]) with a parameter, or `start`, set to `text`. Where the number of
    /// vehicles falls, actions on vehicles that do not exist any more are left out.
    ///
    /// # Errors
    /// An unknown parameter, or a value that is not allowed.
    pub fn with(&self, name: &str, text: &str) -> Result<Scenario, Error> {
        let mut scenario = self.settled();
        if name == "start" {
            scenario.start = text.parse()?;
        } else {
            let parameter = parameter(name)?;
            scenario.set(parameter, parameter.parse(text)?)?;
            if name == "vehicles" {
                let n = scenario.vehicles;
                scenario.actions.retain(|a| a.vehicles.check(n).is_ok());
            }
        }
        scenario.validate()?;
        Ok(scenario)
    }

    /// Sets a parameter to the value in `text`. A parameter of drivers is set for all drivers from now on, and `until` moves
    /// the end of the run. Any other parameter, and every parameter of drivers at t = 0 or after a collision, starts the
    /// run again with the value. Returns whether the run was started again.
    ///
    /// # Errors
    /// As of [`Self::with`]; then nothing has changed.
    pub fn set(&mut self, name: &str, text: &str) -> Result<bool, Error> {
        let running = self.simulation.step_index() > 0 && self.simulation.collision().is_none();
        if name == "until" {
            let until = RoadField::Until.parameter().parse(text)?;
            return self.set_until(until.number().unwrap_or(f64::NAN)).map(|()| false);
        }
        if running && name != "start" {
            let parameter = parameter(name)?;
            if let Field::Driver(field) = parameter.field {
                let effects = vec![Effect::Set(field, parameter.parse(text)?)];
                let action = Action { at: 0.0, vehicles: VehicleSelector::All, effects };
                return self.act(action).map(|()| false);
            }
        }
        *self = Self::new(&self.with(name, text)?)?;
        Ok(true)
    }

    /// What theory would say after [`Self::set`].
    pub fn preview(&self, name: &str, text: &str) -> Result<StabilitySummary, Error> {
        let scenario = self.with(name, text)?;
        let drivers = scenario.drivers();
        let mut rest = drivers.as_slice();
        let mut lanes = Vec::new();
        let vehicles_per_lane = if scenario.vehicles == self.simulation.vehicles()
            && scenario.lanes == self.vehicles_per_lane.len()
        {
            self.vehicles_per_lane.clone()
        } else {
            scenario.vehicles_per_lane()
        };
        for count in vehicles_per_lane {
            let (lane, others) = rest.split_at(count);
            lanes.push(lane.to_vec());
            rest = others;
        }
        Ok(StabilitySummary::of(&lanes, scenario.length, scenario.time_step))
    }

    /// What theory would say at that reaction time with so many vehicles on all lanes, both as typed; without a number of
    /// vehicles, with the vehicles of each lane as they are now.
    pub fn preview_point(
        &self,
        vehicles: Option<&str>,
        reaction_time: &str,
    ) -> Result<StabilitySummary, Error> {
        match vehicles {
            None => self.preview("reaction_time", reaction_time),
            Some(n) => Self::new(&self.with("vehicles", n)?)?.preview("reaction_time", reaction_time),
        }
    }

    /// The same scenario from its beginning, with all its actions, or with those at t = 0 only.
    pub fn restarted(&self, keep_actions: bool) -> Result<Self, Error> {
        let mut scenario = self.simulation.scenario().clone();
        if !keep_actions {
            let steps: Vec<_> = scenario.actions.iter().map(|a| scenario.steps(a.at)).collect();
            let mut k = 0;
            scenario.actions.retain(|_| {
                k += 1;
                steps[k - 1] == 0
            });
        }
        Self::new(&scenario)
    }

    /// The same scenario from its beginning without the action at that index of the list.
    pub fn without(&self, index: usize) -> Result<Self, Error> {
        let mut scenario = self.simulation.scenario().clone();
        if index >= scenario.actions.len() {
            let allowed = format!("a place from 1 to {}", scenario.actions.len());
            return Err(Error::out_of_range("actions", index + 1, allowed));
        }
        scenario.actions.remove(index);
        Self::new(&scenario)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::link;
    use crate::simulation::Simulation;

    fn run(link: &str, seconds: f64) -> Live {
        let mut live = Live::new(&link::parse(link).scenario).unwrap();
        let steps = live.simulation().scenario().steps(seconds) as u32;
        assert_eq!(live.step(steps), steps);
        live
    }

    #[test]
    fn a_driver_parameter_is_set_on_the_way_and_any_other_starts_the_run_again() {
        let mut live = run("action=at%3D0%3A1%3Anudge%3D1", 10.0);
        assert!(!live.set("reaction-time", "0.5").unwrap());
        assert!(live.act("at=0:7:brake=1".parse().unwrap()).is_ok());
        assert_eq!(live.simulation().scenario().actions[1].to_string(), "at=10:all:reaction-time=0.5");
        live.step(100);
        assert!(live.set("vehicles", "40").unwrap());
        let scenario = live.simulation().scenario();
        assert_eq!((scenario.vehicles, scenario.driver.reaction_time), (40, 0.5));
        assert_eq!(scenario.actions.len(), 1, "the nudge at t = 0 only");
        assert_eq!(live.simulation().step_index(), 0);
        let before = live.simulation().scenario().clone();
        assert!(live.set("vehicles", "300").is_err() && live.set("colour", "1").is_err());
        assert_eq!(*live.simulation().scenario(), before, "a refusal changes nothing");
    }

    #[test]
    fn actions_still_to_come_are_kept_when_the_run_starts_again() {
        let actions = "action=at%3D5%3A7%3Abrake%3D3&action=at%3D20%3A45%3Anudge%3D1&action=at%3D30%3Aall%3Asensitivity%3D2";
        let kept = |seconds: f64, vehicles: &str| {
            let mut live = run(actions, seconds);
            live.set("vehicles", vehicles).unwrap();
            live.simulation().scenario().actions.iter().map(Action::to_string).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(kept(0.0, "60"), "at=5:7:brake=3 at=20:45:nudge=1 at=30:all:sensitivity=2");
        assert_eq!(kept(10.0, "60"), "at=20:45:nudge=1 at=30:all:sensitivity=2");
        assert_eq!(kept(10.0, "40"), "at=30:all:sensitivity=2", "there is no vehicle 45");
    }

    #[test]
    fn a_parameter_set_twice_at_one_step_is_kept_once() {
        let mut live = run("reaction-time=0.6&action=at%3D20%3A9%3Abrake%3D1", 5.0);
        let act = |live: &mut Live, text: &str| live.act(Action::at(0.0, text).unwrap()).unwrap();
        for text in ["all:reaction-time=0.3", "7:nudge=1", "3:brake=2"] {
            act(&mut live, text);
        }
        live.set("sensitivity", "1.2").unwrap();
        for text in ["7:nudge=1", "3:brake=3", "all:reaction-time=0.7"] {
            act(&mut live, text);
        }
        // A longer headway needs the shorter vehicle, so that this stays.
        for text in ["5:vehicle-length=4", "5:min-headway=4.5", "5:vehicle-length=4.2"] {
            act(&mut live, text);
        }
        let texts = |live: &Live| {
            live.simulation().scenario().actions.iter().map(Action::to_string).collect::<Vec<_>>().join(" ")
        };
        let kept = "at=20:9:brake=1 at=5:7:nudge=1 at=5:all:sensitivity=1.2 at=5:7:nudge=1 at=5:3:brake=3 \
                    at=5:all:reaction-time=0.7 at=5:5:vehicle-length=4 at=5:5:min-headway=4.5 \
                    at=5:5:vehicle-length=4.2";
        assert_eq!(texts(&live), kept);
        // At another step it is another action.
        live.step(1);
        act(&mut live, "all:reaction-time=0.65");
        assert_eq!(texts(&live), format!("{kept} at=5.01:all:reaction-time=0.65"));
        is_replayed(live);
    }

    #[test]
    fn actions_still_to_come_are_kept_when_a_parameter_is_set_again() {
        let live = |actions: &str| {
            let mut live = run(&format!("reaction-time=0.6&{actions}"), 5.0);
            live.act("at=0:3:sensitivity=1.3".parse().unwrap()).unwrap();
            let count = live.simulation().scenario().actions.len();
            is_replayed(live);
            count
        };
        assert_eq!(live("action=at%3D5%3A3%3Asensitivity%3D1.1&action=at%3D20%3A9%3Abrake%3D1"), 2);
        // The vehicles of a share are drawn by its place in the list.
        assert_eq!(live("action=at%3D5%3A3%3Asensitivity%3D1.1&action=at%3D20%3A20%25%3Abrake%3D1"), 3);
    }

    /// Runs on, and compares with a replay of all of it.
    fn is_replayed(mut live: Live) {
        live.step(2500);
        let mut replay = Simulation::new(&live.so_far()).unwrap();
        replay.run_to(u64::MAX);
        for j in 0..replay.vehicles() {
            let [a, b] = [&replay, live.simulation()].map(|s| s.unwrapped_position(j).to_bits());
            assert_eq!(a, b, "vehicle {}", j + 1);
        }
    }

    #[test]
    fn a_replay_of_the_run_so_far_ends_in_the_same_state() {
        let mut live = run("reaction-time=0.6&lanes=2&start=random", 15.0);
        live.act("at=0:3:brake=2".parse().unwrap()).unwrap();
        live.step(777);
        let mut replay = Simulation::new(&live.so_far()).unwrap();
        replay.run_to(u64::MAX);
        let bits =
            |s: &Simulation| (0..s.vehicles()).map(|j| s.unwrapped_position(j).to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&replay), bits(live.simulation()));
        // A collision belongs to the run so far.
        let mut crash =
            Live::new(&link::parse("reaction-time=1.2&action=at%3D0%3A1%3Anudge%3D1").scenario).unwrap();
        crash.step(100_000);
        let mut replay = Simulation::new(&crash.so_far()).unwrap();
        replay.run_to(u64::MAX);
        assert_eq!(replay.collision(), crash.simulation().collision());
        assert!(replay.collision().is_some());
    }
}
