local measure = require "measure"

return claim {
  id = "N2.7", title = "NIST 2.7: a lift is used",
  source = "NIST TN 1822, test 2.7 (elevator usage), by its title alone; rooms, lift and times are ours",
  text = "No stair leads from room 2 down to room 1. One person calls the lift from below, rides down 3.5 m and leaves; then 24 "
    .. "people do, of whom the lift takes 8 at a time.",
  level = "calm", held_out = measure.walking_law,
  runs = measure.calm({
    one = { scene = "../nist-2-7.yaml", seeds = 1 },
    crowd = { scene = "../nist-2-7.yaml", seeds = "101-103", set = { ["groups.people.count"] = 24, ["groups.people.in"] = "room" } },
  }, "people"),
  quick = { crowd = { seeds = 1 } },
  null = { text = "the lift is out of use", set = { ["lifts.lift.mode"] = "out_of_use" } },
  measure = function(run)
    local one, crowd = run.one.summary, run.crowd.summary
    return {
      out = one.probes.out.forward, wait = one.lifts.lift.wait_mean_s, ride = one.lifts.lift.ride_mean_s,
      all = crowd.probes.out.forward, trips = crowd.lifts.lift.trips, last = crowd.probes.out.last,
      longest = crowd.lifts.lift.wait_max_s,
    }
  end,
  expect = {
    { "out", what = "people who leave, of 1", source = "all", band = { 1, 1 } },
    { "wait", unit = "s", what = "from the call to the step into the car",
      source = "ours, by hand: 4.75 for the car to come, 2 for its door, up to 2.5 for the way in", band = { 6.75, 9.25 } },
    { "ride", unit = "s", what = "from the step into the car to the step out",
      source = "ours, by hand: up to 3 for the door's dwell, 3 and 2 for its motion, 4.75 down, up to 2.5 for the way out",
      band = { 9.75, 15.25 } },
    { "all", what = "people who leave, of 24", source = "all", band = { 24, 24 } },
    { "trips", what = "trips down with people", source = "3: 24 people, 8 at a time", band = { 3, 3 } },
    { "last", unit = "s", what = "until the last of 24 is out", source = "none", reported = true },
    { "longest", unit = "s", what = "longest wait of 24", source = "none", reported = true },
  },
}
