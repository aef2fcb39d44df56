# jostle render: pictures, frames and videos of scenes and recordings; errors and their remedies.
. tests/scenes/lib.sh
render() { "$JOSTLE" render "$@" --quiet; }
people() { grep -cE '<circle id="p|<title>p[0-9]' "$1"; } # discs and torsos in an SVG file
size() { # of a PNG file, from its head
    od -An -j16 -N8 -tu1 "$1" | awk '{print $1 * 16777216 + $2 * 65536 + $3 * 256 + $4 "x" $5 * 16777216 + $6 * 65536 + $7 * 256 + $8}'
}
same() { [ "$2" = "$3" ]; verdict "$1 ($2, $3)" $?; } # NAME GOT WANTED
images=yes; render scenes/circle.yaml --out "$work/first.png" >"$work/out" 2>&1 || images=no
grep -q "CAIRO=0" "$work/out" || images=yes

# ---- SVG ----
render scenes/gates.yaml --at 22 --paths --out "$work/gates.svg" 2>/dev/null; verdict "a picture as SVG" $?
xmllint --noout "$work/gates.svg"; verdict "the SVG is well-formed XML" $?
agents=$("$JOSTLE" run scenes/gates.yaml --for 22 --quiet --summary - 2>/dev/null | figure agents)
same "everybody who is present is drawn" "$(people "$work/gates.svg")" "$agents"
[ "$agents" -gt 0 ] && [ "$agents" -lt 90 ]; verdict "people who have left are not drawn ($agents of 90)" $?
for text in 'class="gate open"' 'class="gate closed"' '<g id="paths"' '>east_gate</text>' '>court</text>' '>t = 22.00 s</text>' '>Gates</text>' '>2 m</text>' 'class="state-Leave"'; do
    grep -qF "$text" "$work/gates.svg" || { echo "not ok the picture lacks $text"; false; }
done
verdict "the picture has layers, names, time and scale" $?
render scenes/gates.yaml --at 22 --paths --threads 2 --out "$work/again.svg" 2>/dev/null
cmp "$work/gates.svg" "$work/again.svg"; verdict "the picture does not depend on the number of threads" $?
render scenes/tawaf.yaml --out "$work/tawaf.svg" 2>/dev/null
same "35,000 people are drawn" "$(people "$work/tawaf.svg")" 35000
[ "$(stat -c %s "$work/tawaf.svg")" -lt 5000000 ]; verdict "their picture has less than 5 MB" $?
xmllint --noout "$work/tawaf.svg"; verdict "and is well-formed XML" $?
render scenes/office.yaml --set groups.people.count=30 --out "$work/office.svg" 2>/dev/null
same "--set changes the scene" "$(people "$work/office.svg")" 30
same "bodies are drawn" "$(sed -n '/<g id="bodies"/,/<\/g>/p' "$work/office.svg" | grep -o '<title>[^<]*' | sort -u | wc -l)" 65
render scenes/door-050.yaml --at 20 --field density --out "$work/floor.svg" 2>/dev/null
sed -n '/<g id="field"/,/<\/g>/p' "$work/floor.svg" | grep -q '<path fill="#'; verdict "--field draws a field" $?
render scenes/circle.yaml --area -1,-1,1,1 --size 400x320 --out "$work/none.svg" 2>/dev/null
same "--area shows only its part" "$(people "$work/none.svg")" 0
grep -q 'width="400" height="320"' "$work/none.svg"; verdict "--size sets the size" $?
for colour in state group speed force compression load density none speed:1.5; do
    render scenes/dodgeball.yaml --at 1 --colour $colour --out "$work/$colour.svg" 2>/dev/null || { echo "not ok --colour $colour"; false; }
    same "--colour $colour draws everyone" "$(people "$work/$colour.svg")" 2
done
for a in state speed force none; do for b in group density compression; do ! cmp -s "$work/$a.svg" "$work/$b.svg" || echo "not ok $a and $b are one picture"; done; done

# ---- recordings ----
"$JOSTLE" run scenes/gates.yaml --for 20 --record "$work/run.sqlite" --quiet 2>/dev/null
render "$work/run.sqlite" --at 15 --out "$work/recorded.svg" 2>/dev/null; verdict "a recording is drawn" $?
render scenes/gates.yaml --at 15 --out "$work/run.svg" 2>/dev/null
same "with as many people as in the run" "$(people "$work/recorded.svg")" "$(people "$work/run.svg")"
states() { sed -n '/<g id="legend"/,$p' "$1" | sed -n 's/.*text-anchor="end">\([0-9,]*\)<.*/\1/p' | tr '\n' ' '; }
same "in the same states" "$(states "$work/recorded.svg")" "$(states "$work/run.svg")"
render "$work/run.sqlite" --scene scenes/gates.yaml --at 15 --out "$work/with.svg" 2>/dev/null
at() { # the middle of the outline of person 7
    sed -n 's/.*<path d="M\([^"]*\)Z"><title>p7<.*/\1/p' "$1" | tr L '\n' | awk '{x += $1; y += $2} END {printf "%.2f %.2f", x / NR, y / NR}'
}
awk -v a="$(at "$work/with.svg")" -v b="$(at "$work/run.svg")" 'BEGIN {
    split(a, p, " "); split(b, q, " "); exit !(p[1] > 0 && (p[1] - q[1]) ^ 2 + (p[2] - q[2]) ^ 2 < 1)}'
verdict "and in the same places, within a pixel ($(at "$work/with.svg"), $(at "$work/run.svg"))" $?
around() { grep -o '<rect[^>]*>\|<path[^>]*>' <(sed -n '/<g id="floor"/,/<g id="places"/p' "$1"); }
"$JOSTLE" run scenes/market.yaml --for 1 --record "$work/market.sqlite" --quiet 2>/dev/null
for from in scenes/market.yaml "$work/market.sqlite"; do render "$from" --at 1 --area 0,0,30,20 --out "$work/$(basename "$from").svg" 2>/dev/null; done
around "$work/market.yaml.svg" | cmp - <(around "$work/market.sqlite.svg") && grep -q 'class="stall"' "$work/market.sqlite.svg"; verdict "a recording has the floor and the scenery of its scene" $?
"$JOSTLE" run scenes/wall-breaking.yaml --set groups.people.count=20 --for 1 --record "$work/wall.sqlite" --quiet 2>/dev/null
"$JOSTLE" render scenes/wall-breaking.yaml --set groups.people.count=20 --at 1 --out "$work/wall.svg" --quiet 2>/dev/null
render "$work/wall.sqlite" --at 1 --scene scenes/wall-breaking.yaml --out "$work/wall2.svg" 2>/dev/null
bodies() { sed -n '/<g id="bodies"/,/<\/g>/p' "$1" | grep -E '<(path|circle)' | sed 's/><title.*//; s|/>||' | sort; }
bodies "$work/wall.svg" >"$work/parts"; bodies "$work/wall2.svg" | cmp - "$work/parts" && [ "$(wc -l <"$work/parts")" -gt 50 ]
verdict "with the same bodies" $?
# Gates and radii of a recording at several times, with and without the scene.
{
    printf 'jostle: 1\nduration: 8\nplaces:\n  room: {polygon: [[0.6, 0.6], [6.4, 0.6], [6.4, 4.4], [0.6, 4.4]]}\n'
    printf '  away: {polygon: [[11, 0], [12, 0], [12, 5], [11, 5]]}\nwalls:\n  - {line: [[7, 1.5], [7, 0], [0, 0], [0, 5], [7, 5], [7, 3.5]]}\n'
    printf '  - {line: [[7, 1.5], [7, 3.5]], name: gate}\ngroups:\n  people: {behaviour: walker.lua, count: 8, in: room, set: {goal: away, breadth: 0.4, depth: 0.4}}\n'
    printf '  prams: {behaviour: walker.lua, count: 3, in: room, spacing: 1.2, set: {goal: away, radius: 0.5, breadth: 1, depth: 1}}\nevents: [{at: 3, open: gate}]\n'
} >"$work/prams.yaml"
"$JOSTLE" run "$work/prams.yaml" --quiet --record "$work/prams.sqlite" >/dev/null 2>&1
looks() { render "$1" --at $2 --area 0,0,12,5 "${@:3}" --out "$work/prams.svg" 2>/dev/null; grep -o 'class="gate [a-z]*' "$work/prams.svg"; grep -o '<circle id="p[^>]* r="[0-9.]*' "$work/prams.svg" | sed 's/.* r=//' | sort | uniq -c; }
for t in 2 6; do
    looks "$work/prams.yaml" $t >"$work/looks"
    [ "$(grep -c 'gate' "$work/looks")" = 1 ] && [ "$(wc -l <"$work/looks")" = 3 ] && looks "$work/prams.sqlite" $t | cmp -s - "$work/looks" && looks "$work/prams.sqlite" $t --scene "$work/prams.yaml" | cmp -s - "$work/looks"
    verdict "a recording has gates and radii as they were at $t s ($(tr -s ' \n' ' ' <"$work/looks"))" $?
done
expect "a time beyond the recording is refused" 3 "which has 0.1 to 20 s" "$JOSTLE" render "$work/run.sqlite" --at 20.4 --out "$work/x.svg"
[ ! -e "$work/x.svg" ]; verdict "and no file is written" $?
printf '1 0 0 0\n1 1 10 0\n1 2 20 0\n' >"$work/bare.txt"
expect "a recording without a frame rate is refused" 3 "--recorded-fps 25" "$JOSTLE" render "$work/bare.txt" --out "$work/bare.svg"
expect "--recorded-fps and --unit give what it lacks" 0 "bare.svg" "$JOSTLE" render "$work/bare.txt" --recorded-fps 10 --unit cm --out "$work/bare.svg"
expect "--colour state is refused for a recording without states" 3 "--colour speed" "$JOSTLE" render "$work/bare.txt" --recorded-fps 10 --unit cm --colour state --out "$work/bare.svg"
printf '1 0 0 0\n1 1 1 0\n1 2 2 0\n2 20 5 5\n2 21 5 4\n' >"$work/gap.txt"
seen=$(for t in 0.1 1 2.1; do render "$work/gap.txt" --recorded-fps 10 --unit m --at $t --out "$work/gap.svg" 2>/dev/null; people "$work/gap.svg"; done | tr '\n' ' ')
same "nobody is drawn when nobody was there" "$seen" "1 0 1 "

# ---- images ----
if [ $images = yes ]; then
    same "a PNG has the size asked for" "$(render scenes/circle.yaml --size 640x480 --out "$work/a.png" 2>/dev/null; size "$work/a.png")" 640x480
    mkdir "$work/frames"; touch "$work/frames/frame-000012.png" "$work/frames/other.png"
    render scenes/dodgeball.yaml --from 1 --until 2 --fps 10 --out "$work/frames" 2>/dev/null; verdict "a folder of frames is written" $?
    same "with the right number of frames" "$(cd "$work/frames" && echo frame-*.png | tr ' ' '\n' | sed -n '1p;$p' | tr '\n' ' ')" "frame-000001.png frame-000011.png "
    [ -e "$work/frames/other.png" ]; verdict "frames of an earlier, longer series are deleted, other files stay" $?
    ! cmp -s "$work/frames/frame-000001.png" "$work/frames/frame-000011.png"; verdict "first and last frame differ" $?
    # A substitute for ffmpeg that counts bytes, chosen by PATH.
    mkdir "$work/bin" "$work/empty"
    printf '#!/bin/sh\necho "$@" >"%s/args"\n/usr/bin/wc -c >"%s/bytes"\nfor last; do :; done; /usr/bin/touch "${last#file:}"\n' "$work" "$work" >"$work/bin/ffmpeg"
    chmod +x "$work/bin/ffmpeg"
    PATH=$work/bin render scenes/dodgeball.yaml --trusted --from 0 --until 1 --size 320x322 --out "$work/run.mp4" 2>/dev/null; verdict "a video is written" $?
    same "every frame is sent to ffmpeg" "$(tr -d ' ' <"$work/bytes")" $((21 * 320 * 322 * 4))
    grep -qF -- "-video_size 320x322 -framerate 20 -i pipe:0" "$work/args"; verdict "with size and frame rate" $?
    printf '#!/bin/sh\nexit 3\n' >"$work/bin/ffmpeg"
    expect "a failure of ffmpeg is an error" 1 "run.mp4'" env PATH="$work/bin" "$JOSTLE" render scenes/dodgeball.yaml --trusted --until 2 --out "$work/run.mp4"
    expect "without ffmpeg a video is an error" 1 "apt-get install ffmpeg" env PATH="$work/empty" "$JOSTLE" render scenes/dodgeball.yaml --until 0.5 --out "$work/none.mp4"
    same "and the frames are kept" "$(find "$work/none-frames" -name 'frame-*.png' | wc -l)" 11
    if command -v ffmpeg >/dev/null; then
        render scenes/dodgeball.yaml --until 1 --out "$work/real.mp4" 2>/dev/null && [ -s "$work/real.mp4" ]; verdict "the real ffmpeg makes a video" $?
    fi
    expect "a video of odd size" 2 "must be even" "$JOSTLE" render scenes/circle.yaml --size 641x480 --out "$work/odd.mp4"
    expect "--at is refused for a folder of frames" 2 "--out FILE.png" "$JOSTLE" render scenes/circle.yaml --at 1 --out "$work/folder"
    expect "--until before --from is refused" 2 "is after --until" "$JOSTLE" render scenes/circle.yaml --from 2 --until 1 --out "$work/folder"
    program=$(realpath "$JOSTLE"); circle=$(realpath scenes/circle.yaml)
    (cd "$work" && "$program" render "$circle" --quiet 2>/dev/null)
    same "without --out the file is named after the scene" "$(size "$work/circle.png")" "$(render scenes/circle.yaml --out "$work/b.png" 2>/dev/null; size "$work/b.png")"
fi

# ---- errors ----
expect "--from is refused for one picture" 2 "--at T" "$JOSTLE" render scenes/circle.yaml --from 1 --out "$work/x.svg"
expect "no such scene" 3 "nowhere.yaml" "$JOSTLE" render "$work/nowhere.yaml" --out "$work/x.svg"
expect "no such recording" 3 "cannot be read" "$JOSTLE" render "$work/nowhere.sqlite" --out "$work/x.svg"
expect "a scene with mistakes" 3 "bad.yaml:2:1" sh -c "printf 'jostle: 1\nwals: []\n' >$work/bad.yaml; $JOSTLE render $work/bad.yaml --out $work/x.svg"
expect "an unwritable file is an error" 1 "cannot write '/proc/none/x.svg'" "$JOSTLE" render scenes/circle.yaml --out /proc/none/x.svg
expect "a time before 0 is refused" 3 "before the scene begins" "$JOSTLE" render scenes/circle.yaml --at -1 --out "$work/x.svg"
for ending in jpg JPEG pdf gif mov; do
    expect "a picture .$ending is refused" 2 "there are no pictures '.$ending'" "$JOSTLE" render scenes/circle.yaml --out "$work/x.$ending"
    [ ! -e "$work/x.$ending" ]; verdict "  and no folder is made" $?
done
expect "  with the nearest ending" 2 "Did you mean '.png'?" "$JOSTLE" render scenes/circle.yaml --out "$work/x.jpg"
expect "a recording's scene by its name" 0 "named.svg" env -C "$work" "$(realpath "$JOSTLE")" render run.sqlite --scene dodgeball --at 1 --out named.svg
expect "a size that is no pair of numbers is refused" 2 "as 1280x720, not '12'" "$JOSTLE" render scenes/circle.yaml --size 12
expect "a size too small" 2 "from 320 to 8192" "$JOSTLE" render scenes/circle.yaml --size 10x10
expect "an empty area is refused" 2 "X0 < X1" "$JOSTLE" render scenes/circle.yaml --area 1,0,0,1
expect "an unknown colour" 2 "not 'pink'" "$JOSTLE" render scenes/circle.yaml --colour pink --out "$work/x.svg"
expect "a bar's end of 0 is refused" 2 "above 0" "$JOSTLE" render scenes/circle.yaml --colour speed:0 --out "$work/x.svg"
expect "an unknown field" 2 "density or pressure" "$JOSTLE" render scenes/circle.yaml --field speed --out "$work/x.svg"
expect "options of recordings for a scene" 2 "this is a scene" "$JOSTLE" render scenes/circle.yaml --unit m
expect "options of scenes for a recording" 2 "taken for a recording" "$JOSTLE" render "$work/run.sqlite" --seed 1
expect "a call without scene and recording is refused" 2 "no scene and no recording" "$JOSTLE" render
expect "an unknown option" 2 "--colour" "$JOSTLE" render scenes/circle.yaml --colours state
expect "render --help" 0 "frame-000001.png" "$JOSTLE" render --help
