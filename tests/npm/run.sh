#!/bin/bash
# tests/npm/run.sh: installs the npm package of `make npm` into an empty folder, and does there what its README says: the example for
# Node.js, and the page in a browser. Checks the types with TypeScript if npm can install that. `make npm-test` runs it.
set -u
cd "$(dirname "$0")/../.."
. tests/scenes/lib.sh
root=$PWD
package=$(ls "$root"/build/out/jostle-*.tgz 2>/dev/null | tail -n 1)
[ -n "$package" ] || { echo "not ok the package is missing: make npm"; exit 1; }
cd "$work" || exit 1
npm_install() { npm install --no-audit --no-fund --loglevel=error "$@" >npm.log 2>&1; }

npm_install "$package"
verdict "package is installed" $?
node node_modules/jostle/examples/crowd.mjs >said 2>&1 && grep -q 'behaviours/leave.lua: .* is live' said && tail -n 1 said | grep -qE '^hash [0-9a-f]{16}$'
status=$?
verdict "example of Node.js runs, and reloads its behaviour" $status
[ $status = 0 ] || cat said

if npm_install typescript@5; then
    cat >types.mts <<'END'
import { Engine, Scene, JostleError, type Fault } from "jostle";
const scene = await Scene.load({ scene: "scenes/circle.yaml", set: { "groups.crossing.count": 5 } });
const x: Float32Array = scene.column("x");
const faults: Fault[] = scene.reload({}).errors;
const words: string[] = (await Engine.create()).vocabulary().map((row) => row.word);
// @ts-expect-error: the path of a scene is missing
await Scene.load({});
console.log(x.length, faults, words, scene.events().hits[0]?.impulse, JostleError);
END
    npx tsc --noEmit --strict --target es2022 --module nodenext --lib es2022,dom types.mts >types.log 2>&1
    status=$?
    verdict "types fit" $status
    [ $status = 0 ] || cat types.log
else
    echo "types are not checked: npm could not install typescript"
fi

cp "$root/build/node/node_modules/three" node_modules/ -R && cp node_modules/jostle/examples/page/* .
/usr/bin/python3 "$root/tests/npm/page.py" "$work"
