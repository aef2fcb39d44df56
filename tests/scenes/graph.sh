# jostle graph: the states and transitions of behaviours, as text and as pictures; errors and their remedies.
. tests/scenes/lib.sh
dot_has() { # NAME TEXT...: the graph in $work/out has each text
    local name=$1 text; shift
    for text in "$@"; do grep -qF -- "$text" "$work/out" || { echo "not ok $name: lacks $text"; return; }; done
    echo "ok $name"
}

# ---- the text of a graph ----
"$JOSTLE" graph behaviours/tawaf.lua --dot >"$work/out" 2>&1; verdict "a graph as text" $?
dot_has "each state is a box with what it does" '<b>Circle</b><br/><font point-size="9">orbit &quot;kaaba&quot;' '<b>Pass</b>' 'lasts uniform(6, 12)'
dot_has "conditions are as the file has them, in order, broken at operators" '1. mine.laps:at_least(6)<br' '2. at_line &amp; near(&quot;black_stone&quot;, 10)<br align="left"/>&amp; ~crowded' 'chance 0.03<br'
dot_has "functions are named by their line" "on_exit: function, tawaf.lua:$(grep -n 'on_exit = function' behaviours/tawaf.lua | cut -d: -f1)"
dot_has "variables that conditions name are listed" 'at_line = crosses &quot;start_line&quot;<br' 'crowded = density(&quot;black_stone&quot;):above(6)<br'
[ "$(grep -c 'peripheries=2' "$work/out")" = 1 ]; verdict "a state that removes people has a double frame" $?
[ "$(grep -cE '^  s[0-9]+ -> s[0-9]+ ' "$work/out")" = "$(grep -c '{ to = ' behaviours/tawaf.lua)" ]; verdict "each transition is an arrow" $?
for file in behaviours/*.lua; do "$JOSTLE" graph "$file" --dot >"$work/$(basename "$file" .lua).dot" || echo "not ok $file"; done
verdict "every shipped behaviour has a graph" $?

# ---- hostile and odd behaviours ----
cat >"$work/odd.lua" <<'END'
local far = distance "<post> ]]> \"& \\l"
local unused, kept = after(7), 5
local function build() return { { to = "Guard.Rest", when = after(kept) } } end
local deep = machine { start = "Deep", states = { Deep = { steer = hold, { to = "End", when = after(3) } }, End = { ends = true } } }
return machine { name = "odd", start = "Guard.Walk", states = {
  ["Guard.Walk"] = { steer = function(me) return 0, 0 end,
    { to = "Guard.Rest", when = function(me) return false end, chance = 0.5, set = { tags = "a" }, on_take = function(me) end },
    { to = "Guard.Walk", id = "again", when = far:above(1) & after(1) & after(2) & after(3) & after(4) & after(5) & after(6) & after(8)
      & after(9) & after(10) & after(11) & after(12) & after(13) & after(14) & after(15) & after(16) & after(17) & after(18) },
    { to = "Out" } },
  ["Guard.Rest"] = { steer = hold, { when = heard "call", every = 2, set = { tags = "a" } }, { to = "Late" } },
  Late = build(),
  Outer = { on_exit = function(me) end, runs = machine { start = "Inner", states = {
      Inner = { runs = deep, { to = "Flat", when = done } }, Flat = { steer = spread, { to = "Inner", when = after(4) } } } },
    { to = back, when = after(9) } },
  ["Out"] = { become = "stander" } } }
END
expect "texts that are markup are quoted" 0 'far = distance &quot;&lt;post&gt; ]]&gt;' "$JOSTLE" graph "$work/odd.lua" --dot
dot_has "a change to another behaviour is told" '<b>Out</b>' 'becomes stander'
dot_has "states of a machine within a state stand in a frame" 'subgraph cluster_0' '  label=<<b>Outer</b>' 'on_exit: function, odd.lua:' '  label=<<b>Inner</b>' '<b>Deep</b><br/><font point-size="9">hold' '<b>Flat</b><br/><font point-size="9">spread' 'the machine ends'
[ "$(grep -c 'ltail=cluster_' "$work/out")" = 2 ]; verdict "  transitions of the outer state begin at its frame, once" $?
dot_has "  with their conditions" 'label=<done<br' 'label=<after(3)<br' 'label=<after(4)<br' 'label=<after(9)<br' 'label="back"'
dot_has "functions in conditions and steering are named" '>function, odd.lua:6' '1. function, odd.lua:7' 'chance 0.5' 'set: tags = &quot;a&quot;' 'on_take: function, odd.lua:7' '3. at once'
dot_has "reactions stand in the box of their state, and count as no transition" '>if heard &quot;call&quot;<br align="left"/>&#160;&#160;&#160;every 2<br align="left"/>&#160;&#160;&#160;set: tags' 'label=<at once<'
dot_has "a long condition is cut" ' ...<br'
dot_has "conditions are found that a function builds" 'label=<after(kept)<'
! grep -q unused "$work/out"; verdict "variables that nothing names are left out" $?
dot_has "  and others are not" 'kept = 5'
if command -v dot >/dev/null; then
    "$JOSTLE" graph "$work/odd.lua" --out "$work/odd.svg" >"$work/said" 2>&1; verdict "the graph of hostile texts is drawn" $?
    xmllint --noout "$work/odd.svg"; verdict "  as well-formed XML" $?
fi

cat >"$work/drop.lua" <<'END'
local mine = memory { n=0 }
return machine { name = "drop", start = "Go", states = { Go = { steer = hold, drop = nearest "ball", { to = "Go", id = "x", when = after(1), set={n=mine.n+10} } } } }
END
expect "a drop is drawn, and actions without blanks are whole" 0 'drop: nearest &quot;ball&quot;' "$JOSTLE" graph "$work/drop.lua" --dot
dot_has "  in braces" 'set: n=mine.n+10<'

cat >"$work/steps.lua" <<'END'
return machine { name = "steps", start = "Leave", states = {
  Leave = { runs = sequence { seek "door", wait(2) }, { to = "Gone", when = done } }, Gone = { removes = true } } }
END
expect "steps of a sequence follow one another" 0 'label=<when it is over<' "$JOSTLE" graph "$work/steps.lua" --dot
dot_has "  with steering and seconds" '<b>1 seek door</b><br/><font point-size="9">seek(door)<' '<b>2 wait</b><br/><font point-size="9">hold<br align="left"/>lasts 2 s<'
dot_has "  in a frame" '<b>1 seek door</b>' '<b>2 wait</b>' 'label=<done<'

# ---- pictures ----
if command -v dot >/dev/null; then
    "$JOSTLE" graph behaviours/outbreak.lua --out "$work/outbreak.svg" >"$work/said" 2>&1; verdict "a graph as SVG" $?
    xmllint --noout "$work/outbreak.svg"; verdict "  is well-formed XML" $?
    for state in Calm Flee Hide Hidden Bitten Infected Held; do grep -qF ">$state</text>" "$work/outbreak.svg" || echo "not ok $state is missing"; done
    [ ! -s "$work/said" ]; verdict "  and nothing is said" $?
    "$JOSTLE" graph behaviours/outbreak.lua --out "$work/outbreak.png" && [ "$(head -c 4 "$work/outbreak.png" | tail -c 3)" = PNG ]; verdict "a graph as PNG" $?
    (cd "$work" && "$OLDPWD/$JOSTLE" graph odd.lua && [ -s odd.svg ]); verdict "without --out it is NAME.svg in the present folder" $?
    expect "a folder that is not there" 1 "cannot write" "$JOSTLE" graph behaviours/tawaf.lua --out "$work/none/x.svg"
fi
"$JOSTLE" graph behaviours/tawaf.lua --out "$work/tawaf.dot"; verdict "the text into a file" $?
"$JOSTLE" graph behaviours/tawaf.lua --dot | cmp - "$work/tawaf.dot"; verdict "  is what --dot prints" $?
mkdir "$work/bin"
for tool in timeout grep head; do ln -s "$(command -v $tool)" "$work/bin/"; done
PATH=$work/bin expect "a missing dot is named, with a way out" 1 "install Graphviz (Debian: graphviz), or take --dot" "$JOSTLE" graph behaviours/tawaf.lua --out "$work/none.svg"
[ ! -e "$work/none.svg" ] && [ ! -e "$work/none.svg.part" ]; verdict "  and no file is left" $?
printf '#!/bin/sh\necho "broken in line 3" >&2; exit 1\n' >"$work/bin/dot"; chmod +x "$work/bin/dot"
PATH=$work/bin expect "what dot says when it fails is told" 1 "dot could not draw the graph: broken in line 3" "$JOSTLE" graph behaviours/tawaf.lua --trusted --out "$work/none.svg"

# ---- scenes ----
expect "the only behaviour of a scene" 0 "<b>tawaf</b>" "$JOSTLE" graph scenes/tawaf.yaml --set groups.pilgrims.count=1 --dot
expect "of several one must be named" 2 "several behaviours: say --behaviour with one of" "$JOSTLE" graph scenes/metro.yaml --dot
name=$(sed -n 's/.*with one of \([^,]*\),.*/\1/p' "$work/out")
expect "  by its name" 0 "label=<<b>$name</b>>" "$JOSTLE" graph scenes/metro.yaml --behaviour "$name" --dot
expect "  and an unknown one is told" 2 "no behaviour 'nothing', but" "$JOSTLE" graph scenes/metro.yaml --behaviour nothing --dot
mkdir -p "$work/mods/far/patches"
printf 'name: far\ntitle: Far\nversion: 1.0.0\napi: 1\n' >"$work/mods/far/mod.yaml"
printf 'return patch "tawaf" { states = { Circle = { steer = seek "kaaba" } } }\n' >"$work/mods/far/patches/tawaf.lua"
expect "mods change the graph" 0 'seek &quot;kaaba&quot;' "$JOSTLE" graph scenes/tawaf.yaml --mod "$work/mods/far" --set groups.pilgrims.count=1 --dot

cat >"$work/inner.lua" <<'END'
return machine { name = "m", start = "P", states = {
  P = { runs = sequence { wait(1), wait(2) }, { to = "Q", when = heard "x", set = { team = "red" } } },
  Q = { steer = hold, { to = back, when = after(1) } } } }
END
"$JOSTLE" graph "$work/inner.lua" --dot >"$work/out"
same "what an outer transition does is not drawn at inner ones" "$(grep -c 'team = ' "$work/out")" 1

# ---- mistakes ----
printf 'return machine { name = "m", start = "A", states = { A = { steer = hold, { to = "B" } } } }\n' >"$work/wrong.lua"
expect "a behaviour with errors" 3 "wrong.lua:1:76" "$JOSTLE" graph "$work/wrong.lua" --dot
expect "a missing file" 3 "behaviours/tawag.lua" "$JOSTLE" graph behaviours/tawag.lua
expect "no file" 2 "no behaviour and no scene given" "$JOSTLE" graph
expect "--behaviour with a behaviour" 2 "are for scenes" "$JOSTLE" graph behaviours/tawaf.lua --behaviour tawaf
expect "--dot and --out" 2 "take --out FILE.dot" "$JOSTLE" graph behaviours/tawaf.lua --dot --out x.dot
expect "an ending that is none of pictures" 2 "looks like something else" "$JOSTLE" graph behaviours/tawaf.lua --out "$work/x.txt"
