// A crowd leaves a room of its own; after 10 s its behaviour is reloaded, and everybody hurries.
import process from "node:process";
import { Scene, JostleError } from "jostle";

const room = `jostle: 1
duration: 60
places:
  hall: {polygon: [[0.4, 0.4], [9.6, 0.4], [9.6, 7.6], [0.4, 7.6]]}
  outside: {polygon: [[12, 2], [13, 2], [13, 6], [12, 6]]}
walls:
  - {line: [[10, 3.4], [10, 0], [0, 0], [0, 8], [10, 8], [10, 4.6]]}
groups:
  people: {behaviour: ../behaviours/leave.lua, count: 60, in: hall}
`;
const leave = (speed) => `return machine { name = "leave", start = "Leave", defaults = { speed = ${speed} },
  states = {
    Leave = { steer = field "outside", { to = "Out", when = inside "outside" } },
    Out = { removes = true } } }
`;
try {
    const scene = await Scene.load({
        files: { "scenes/room.yaml": room, "behaviours/leave.lua": leave(0.8) },
        scene: "scenes/room.yaml",
        say: (text) => console.log(`  ${text}`),
    });
    while (scene.time < scene.duration && scene.agents > 0) {
        scene.step(20);
        const vx = scene.column("vx");
        const mean = vx.reduce((sum, v) => sum + v, 0) / (vx.length || 1);
        console.log(`${scene.time.toFixed(0)} s: ${scene.agents} people, ${mean.toFixed(2)} m/s towards the door`);
        if (scene.tick === 200) scene.reload({ "behaviours/leave.lua": leave(1.6) });
    }
    console.log(`hash ${scene.hash}`);
    scene.close();
} catch (error) {
    if (!(error instanceof JostleError)) throw error;
    process.exitCode = 1;
    for (const fault of error.errors) console.error(`${fault.file}:${fault.line}:${fault.column}: ${fault.text}`, fault.wayOut);
}
