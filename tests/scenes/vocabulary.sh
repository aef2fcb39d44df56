# Runs the machines of tests/lua: every agent must end in the state Pass.
. tests/scenes/lib.sh
for file in tests/lua/*.lua; do
    case $file in *_test.lua) continue ;; esac # run by jostle test (lua_tests.sh)
    name=$(basename "$file" .lua)
    cp -R "$file" tests/lua/parts "$work/"
    cat >"$work/scene.yaml" <<END
jostle: 1
places:
  yard: {polygon: [[0, 0], [20, 0], [20, 20], [0, 20]]}
  mid: {line: [[10, 0], [10, 20]]}
  post: {point: [5, 10]}
  far: {point: [18, 18], radius: 1}
  ends: {set: [post, far]}
  row: {queue: [[15, 10], [15, 5]], spacing: 0.6}
bodies:
  - {shape: {sphere: {radius: 0.11}}, mass: 0.4, at: [3, 3, 0.11], tags: [ball]}
groups:
  people: {behaviour: $name.lua, at: [[12, 8], [12, 10], [12, 12]], tags: [people]}
END
    "$JOSTLE" run "$work/scene.yaml" --for 25 --quiet --summary "$work/$name.json" >"$work/log" 2>&1
    if grep -q '"Pass": 3' "$work/$name.json" 2>/dev/null; then echo "ok $name"; else
        echo "not ok $name"; cat "$work/log"; grep states "$work/$name.json"; fi
done
# Shipped scenes fit the JSON Schema that editors use.
/usr/bin/python3 - >"$work/schema" 2>&1 <<'E'
import glob, json, jsonschema, yaml
check = jsonschema.Draft7Validator(json.load(open("scripts/scene.schema.json")))
files = glob.glob("scenes/*.yaml")
assert len(files) > 50
for file in sorted(files):
    for error in check.iter_errors(yaml.safe_load(open(file))):
        print(file, list(error.path), error.message[:200])
E
[ ! -s "$work/schema" ]; verdict "every shipped scene fits the JSON Schema" $?
cat "$work/schema"
