local function run(perception, push)
  return { scene = "../rude-polite.yaml", seeds = 64,
    set = { ["groups.walker.set.perception"] = perception, ["groups.walker.set.push"] = push } }
end

return claim {
  id = "15", title = "From rude to polite",
  source = "Kim et al. 2014, section 4.1",
  text = "One walks through a crowd that stands loosely. Who looks a short way ahead and pushes hard is fast and "
    .. "moves others; who looks far and pushes little is slow and leaves them where they are. Five steps, from rude "
    .. "to polite; each has to go the same way, by more "
    .. "than the 95 % bound of the mean over the seeds.",
  level = "normal",
  held_out = "no constant of the engine or of a behaviour was chosen on it; the five steps of perception and push are "
    .. "the claim's own",
  runs = {
    s1 = run(1, 240), s2 = run(2, 120), s3 = run(3, 60), s4 = run(4, 30), s5 = run(6, 15),
  },
  quick = { s1 = { seeds = 24 }, s2 = { seeds = 24 }, s3 = { seeds = 24 }, s4 = { seeds = 24 }, s5 = { seeds = 24 } },
  null = { text = "the same perception and push in all five steps", set = { ["groups.walker.set.perception"] = 3, ["groups.walker.set.push"] = 60 } },
  measure = function(run)
    local function transit(name) return run[name].summary.probes.passage.mean end
    local function moved(name) return 100 * run[name].summary.probes.standing.peak_mean end
    return {
      slower_12 = transit("s2") - transit("s1"), slower_23 = transit("s3") - transit("s2"),
      slower_34 = transit("s4") - transit("s3"), slower_45 = transit("s5") - transit("s4"),
      calmer_12 = moved("s1") - moved("s2"), calmer_23 = moved("s2") - moved("s3"),
      calmer_34 = moved("s3") - moved("s4"), calmer_45 = moved("s4") - moved("s5"),
      transit_rude = transit("s1"), transit_polite = transit("s5"), moved_rude = moved("s1"),
      moved_polite = moved("s5"),
    }
  end,
  expect = {
    { "slower_12", unit = "s", what = "transit time, perception 2 m and push 120 N per m/s over 1 m and 240",
      source = "> 0", sure = true, band = { 0.01 } },
    { "slower_23", unit = "s", what = "the same, 3 m and 60 over 2 m and 120", source = "> 0", sure = true, band = { 0.01 } },
    { "slower_34", unit = "s", what = "the same, 4 m and 30 over 3 m and 60", source = "> 0", sure = true, band = { 0.01 } },
    { "slower_45", unit = "s", what = "the same, 6 m and 15 over 4 m and 30", source = "> 0", sure = true, band = { 0.01 } },
    { "calmer_12", unit = "cm", what = "greatest displacement, mean of those who stand, 1 m and 240 over 2 m and 120",
      source = "> 0", sure = true, band = { 0.01 } },
    { "calmer_23", unit = "cm", what = "the same, 2 m and 120 over 3 m and 60", source = "> 0", sure = true, band = { 0.01 } },
    { "calmer_34", unit = "cm", what = "the same, 3 m and 60 over 4 m and 30", source = "> 0", sure = true, band = { 0.01 } },
    { "calmer_45", unit = "cm", what = "the same, 4 m and 30 over 6 m and 15", source = "> 0", sure = true, band = { 0.01 } },
    { "transit_rude", unit = "s", what = "transit time of the rudest", reported = true },
    { "transit_polite", unit = "s", what = "of the most polite", reported = true },
    { "moved_rude", unit = "cm", what = "greatest displacement, mean by the rudest", reported = true },
    { "moved_polite", unit = "cm", what = "by the most polite", reported = true },
  },
  pictures = { s1 = { "paths.png", "standing.png" }, s5 = { "paths.png", "standing.png" } },
}
