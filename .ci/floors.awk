# Fills floor_of[folder] with the floor of each folder of core, for layers.awk and calls.awk. A folder may use folders
# with a lower whole number, and of the folders below the same top folder those with a lower fraction.
function floors(floor_of,    words, i) {
    split("include 0 simd 0 base 0.1 base/number 0.2 base/format 0.3 task 1 geom 1 geom/field 1.1 geom/ground 1.1 agents 1 nav/spots 2.1 nav 2.2 nav/near 2.3 nav/walk 2.3 nav/orca 2.4 nav/move 2.4 force 2 force/push 2.1 force/support 2.1 force/contact 2.2 force/stages 2.3 body 2 machine 2 machine/steering 2.1 world/input 3.1 world/step_events 3.1 world/routes 3.1 world 3.2 world/verbs 3.3 world/embed 3.4 " \
          "scene/format 4.1 scene/wall_files 4.1 scene 4.2 scene/reference 4.3 lua/vm 4.1 lua/language 4.2 lua 4.3 record/fields 4.1 record 4.2 record/probes 4.3 record/danger 4.4 view 4 picture 5 run/watch 5.1 run 5.2 run/resume 5.3 run/results 5.3 run/why 5.3 run/mods 5.4 " \
          "live 6 report 6 render 6 validate 6 luatest 6 wasm 7 sweep 7.1 sweep/compare 7.2 cli/bench 8.1 cli 8.2", words, " ")
    for (i = 1; (i + 1) in words; i += 2) floor_of[words[i]] = words[i + 1]
}
