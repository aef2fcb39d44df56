# Functions of mods that extend a function, a condition or a steering: before, afterwards, around, in place of.
. tests/scenes/lib.sh
program=$(case $JOSTLE in /*) echo "$JOSTLE" ;; *) echo "$PWD/$JOSTLE" ;; esac)
tree=$work/tree
mkdir -p "$tree/behaviours" "$tree/scenes"
cp -R scripts "$tree/"
cd "$tree" || exit 1
cat >behaviours/yard.lua <<'END'
local mine = memory { trail = 0 }
local function step(digit) return function(me) me.trail = me.trail * 10 + digit end end
return machine { name = "yard", version = 1, start = "Go",
  states = {
    Go = { steer = drift(1, 0), max_speed = 5, on_enter = step(5), on_exit = step(6),
      { to = "Rest", when = after(0.5), on_take = step(7) } },
    Rest = { steer = hold, on_enter = step(8) },
  } }
END
printf 'jostle: 1\nplaces: {goal: {point: [9, 0]}}\ngroups: {g: {behaviour: yard.lua, at: [[0, 0], [0, 4]]}}\n' >scenes/yard.yaml
mod() { # NAME YAML PATCH
    mkdir -p "scenes/mods/$1/patches"
    printf 'name: %s\nversion: 1.0\napi: 1\n%s\n' "$1" "$2" >"scenes/mods/$1/mod.yaml"
    printf 'local function step(digit) return function(me) me.trail = me.trail * 10 + digit end end\nreturn patch "yard" { states = %s }\n' "$3" >"scenes/mods/$1/patches/yard.lua"
}
two=(--mod alpha --mod beta)
trail() { # NAME DIGITS OPTION...: what agent 0 remembers at 2 s of the functions that ran
    local name=$1 digits=$2; shift 2
    expect "$name" 0 "state Rest: $digits" "$program" mod why trail scenes/yard.yaml --agent 0 --at 2 "$@"
}
run=("$program" run scenes/yard.yaml --for 2 --quiet)
trail "without mods each function runs alone" 5678
mod alpha "" '{ Go = { on_enter = before(step(1)) } }'
mod beta "" '{ Go = { on_enter = before(step(2)) } }'
trail "the later mod runs before the earlier one" 215678 "${two[@]}"
mod beta "load_after: []" '{ Go = { on_enter = afterwards(step(2)) } }'
trail "one before, another afterwards" 152678 "${two[@]}"
"${run[@]}" "${two[@]}" >"$work/said" 2>&1
! grep -q warning "$work/said"; verdict "  that is no conflict" $?
expect "  mod why lists all of them" 0 "alpha/patches/yard.lua:2:41: before(step(1))   (mod alpha 1.0)" "$program" mod why yard.Go.on_enter scenes/yard.yaml "${two[@]}"
expect "  the last one too" 0 "beta/patches/yard.lua:2:41: afterwards(step(2))   (mod beta 1.0)" "$program" mod why yard.Go.on_enter scenes/yard.yaml "${two[@]}"
expect "  and says that none replaces the others" 0 "the last one counts, and what it extends with it" "$program" mod why yard.Go.on_enter scenes/yard.yaml "${two[@]}"
expect "  costs are counted for each, by mod" 0 "state Go > on_enter (afterwards, mod beta)" "$program" run scenes/yard.yaml --for 2 --quiet --profile-lua "${two[@]}"
mod alpha "" '{ Go = { change = { Rest = { on_take = around(function(me, previous) step(1)(me) previous(me) end) } } } }'
mod beta "" '{ Go = { change = { Rest = { on_take = around(function(me, previous) previous(me) step(4)(me) end) } } } }'
trail "around calls the former function, which may be around another" 561748 "${two[@]}"
mod beta "" '{ Go = { change = { Rest = { on_take = around(function(me, previous) step(3)(me) end) } } } }'
trail "  or does not" 5638 "${two[@]}"
mod beta "" '{ Go = { change = { Rest = { on_take = step(9) } } } }'
trail "a plain function stands in place of all before it" 5698 "${two[@]}"
expect "  which is a conflict, and reported" 0 "warning: mods alpha and beta both set states.Go.@Rest.on_take" "${run[@]}" "${two[@]}"
mod alpha "" '{ Go = { on_exit = step(1) } }'
mod beta "" '{ Go = { on_exit = before(step(2)) } }'
trail "a function that replaces is extended by a later mod" 52178 "${two[@]}"
"${run[@]}" "${two[@]}" >"$work/said" 2>&1
! grep -q warning "$work/said"; verdict "  without a conflict" $?
expect "  its cost is that of its mod" 0 "state Go > on_exit (mod alpha)" "$program" run scenes/yard.yaml --for 2 --quiet --profile-lua "${two[@]}"
mod alpha "" '{ Rest = { on_exit = before(step(1)) }, Go = { on_exit = none } }'
mod beta "" '{ Go = { on_exit = before(step(2)) } }'
trail "where nothing stands, the function runs alone" 5278 "${two[@]}"

# Conditions and steering.
mod alpha "" '{ Go = { change = { Rest = { when = around(function(me, previous) return previous(me) and me.time > 1.02 end) } } } }'
expect "when: around calls the former condition" 0 "Go 2" "$program" run scenes/yard.yaml --for 1 --mod alpha
expect "  and joins what it likes" 0 "Rest 2" "$program" run scenes/yard.yaml --for 1.2 --mod alpha
mod beta "" '{ Go = { change = { Rest = { when = before(function(me) me.trail = 4 end) } } } }'
trail "when: before and afterwards leave the answer alone" 4678 --mod beta
mod beta "" '{ Go = { change = { Rest = { when = afterwards(function(me) return true end) } } } }'
expect "  what they return is an error" 1 "beta/patches/yard.lua:2: what runs before or afterwards returns nothing here: the result is changed by \`around\`" "${run[@]}" --mod beta
expect "  which names function and mod" 1 "machine yard > state Go > transition Rest > when (afterwards, mod beta); agent 0, step " "${run[@]}" --mod beta
expect "  and leaves the condition at work" 1 "Rest 2" "$program" run scenes/yard.yaml --for 1 --mod beta
mod alpha "" '{ Go = { steer = around(function(me, previous) local x, y = previous(me) return -x, y end) } }'
mod beta "" '{ Go = { steer = around(function(me, previous) local x, y = previous(me) return y, -2 * x end),
    on_exit = function(me) me.trail = math.floor(2 * me.y + 0.5) end, on_enter = none }, Rest = { on_enter = none },
    }'
mod gamma "" '{ Go = { change = { Rest = { on_take = none } } } }'
trail "steer: around gets the compiled velocity, and the next one what that returns" 2 "${two[@]}" --mod gamma
mod beta "" '{ Go = { steer = before(function(me) return 3, 3 end) } }'
expect "  what runs before it returns nothing" 1 "what runs before or afterwards returns nothing here" "${run[@]}" --mod beta

# States within states.
cat >behaviours/inner.lua <<'END'
local mine = memory { trail = 0 }
local function step(digit) return function(me) me.trail = me.trail * 10 + digit end end
local patrol = machine { name = "patrol", start = "Walk", states = {
  Walk = { steer = drift(1, 0), on_enter = step(2), { to = "Look", when = after(0.3) } },
  Look = { steer = hold, on_enter = step(3) } } }
return machine { name = "yard", version = 1, start = "Guard", states = {
  Guard = { runs = patrol, on_enter = step(1) } } }
END
cp behaviours/yard.lua yard.lua; cp behaviours/inner.lua behaviours/yard.lua
mod alpha "" '{ Guard = { on_enter = before(step(7)), runs = { states = { Walk = { on_enter = afterwards(step(8)) } } } } }'
mod beta "" '{ Guard = { runs = { states = { Look = { on_enter = around(function(me, previous) previous(me) step(9)(me) end) } } } } }'
expect "functions of states within states are extended" 0 "state Guard.Look: 712839" "$program" mod why trail scenes/yard.yaml --agent 0 --at 2 "${two[@]}"
cp yard.lua behaviours/yard.lua

# Failures.
mod alpha "" '{ Go = { on_enter = around(function(me, previous) previous(me) end) } }'
mod beta "" '{ Go = { on_enter = before(function(me) error("no") end) } }'
trail "a function of a mod that fails leaves the others at work" 5678 "${two[@]}"
expect "  its error names the mod, with the line" 1 "beta/patches/yard.lua:2: no" "${run[@]}" "${two[@]}"
expect "  and the part" 1 "machine yard > state Go > on_enter (before, mod beta); agent 0, step 0" "${run[@]}" "${two[@]}"
sed -i 's/max_speed = 5, on_enter = step(5)/max_speed = 5, on_enter = function(me) return nil + 1 end/' behaviours/yard.lua
expect "a failure within previous(me) is that of the former function" 1 "machine yard > state Go > on_enter; agent 0" "${run[@]}" --mod alpha
expect "  with the line of the call in the mod" 1 "   at scenes/mods/alpha/patches/yard.lua:2" "${run[@]}" --mod alpha
sed -i 's/max_speed = 5, on_enter = function(me) return nil + 1 end/max_speed = 5, on_enter = step(5)/' behaviours/yard.lua
mod alpha "" '{ Go = { on_enter = around(function(me, previous) previous() end) } }'
expect "previous takes me" 1 "the former function takes \`me\`: write previous(me)" "${run[@]}" --mod alpha
mod alpha "" '{ Go = { steer = around(function(me, previous) error("no") end),
  on_exit = function(me) me.trail = math.floor(me.x + 0.6) end, on_enter = none,
  change = { Rest = { on_take = none, when = after(4) } } }, Rest = { on_enter = none } }'
"${run[@]}" --dt 0.01 --mod alpha >"$work/said" 2>&1
grep -q "state Go > steer (around, mod alpha): it failed 100 times within a second and is suspended" "$work/said"; verdict "a function of a mod that fails again and again is suspended" $?
printf "step: 0.01\n" >>scenes/yard.yaml
expect "  and what it extends works on alone" 0 "state Rest: 5" "$program" mod why trail scenes/yard.yaml --agent 0 --at 6 --mod alpha

# Refusals.
mod alpha "" '{ Go = { push = before(step(1)) } }'
expect "a key without functions" 3 "alpha/patches/yard.lua:2:41: 'push' holds no function that could be extended. before, afterwards and around extend on_enter, on_exit, on_take, when and steer" "${run[@]}" --mod alpha
mod alpha "" '{ Go = { on_enter = before(3) } }'
expect "something else than a function" 3 "alpha/patches/yard.lua:2:52: before takes one function. Example: on_enter = before(function(me) me.laps = 0 end)" "${run[@]}" --mod alpha
mod alpha "" '{ Go = { on_enter = around(math.abs) } }'
expect "a function of Lua itself" 3 "around takes one function. Example: on_enter = around(function(me, previous) previous(me) end)" "${run[@]}" --mod alpha
mod alpha "" '{ Go = { on_enter = befor(step(1)) } }'
expect "a misspelt word" 3 "unknown word 'befor'. Did you mean 'before'?" "${run[@]}" --mod alpha
sed 's/on_exit = step(6)/on_exit = before(step(6))/' behaviours/yard.lua >behaviours/wrong.lua
expect "a behaviour itself extends nothing" 3 "wrong.lua:5:78: 'before' works in mods only. Put it into the patches/ of a mod; here write the function itself" "$program" run scenes/yard.yaml --steps 1 --quiet --set groups.g.behaviour=wrong.lua
