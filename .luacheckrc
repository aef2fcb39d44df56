-- The words of behaviours, for luacheck.
std = {
  read_globals = {
    "inside", "crosses", "near", "touches", "first_in", "after", "stuck", "hit_by", "grounded",
    "incoming", "kicked", "sees", "density", "count", "distance", "min", "max", "abs", "sqrt",
    "clamp", "nearest", "one_of", "seek", "away_from", "queue", "along", "follow", "drift",
    "circuits", "lasted", "density_here", "headway", "pushed", "compression", "contacts",
    "time_in_state", "goal", "hold", "spread", "player", "machine", "memory", "orbit", "normal",
    "uniform", "choose", "now", "own", "require", "pairs", "ipairs", "next", "type", "tostring",
    "tonumber", "error", "assert", "math", "string", "table",
  },
}
max_line_length = 120
