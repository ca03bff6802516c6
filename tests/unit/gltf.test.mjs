/** glTF files, as the Rust tests hold them, by Khronos' validator and by three.js. */
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { validateBytes } from "gltf-validator";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

const folder = "tests/fixtures/gltf";
const names = readdirSync(folder).filter((name) => name.endsWith(".glb"));

test("there are files of every kind of cells", () => {
  assert.deepEqual(names.sort(), [
    "lines.glb",
    "many-modes.glb",
    "plane.glb",
    "points.glb",
    "triangles.glb",
  ]);
});

for (const name of names) {
  const bytes = new Uint8Array(readFileSync(join(folder, name)));

  test(`${name} is valid`, async () => {
    const report = await validateBytes(bytes);
    assert.deepEqual(report.issues.messages, []);
  });

  test(`${name} opens in three.js with a slider for every mode`, async () => {
    const { scene } = await new GLTFLoader().parseAsync(bytes.slice().buffer, "");
    const meshes = [];
    scene.traverse((object) => object.geometry && meshes.push(object));
    assert.equal(meshes.length, 1);
    const [mesh] = meshes;
    const labels = Object.keys(mesh.morphTargetDictionary ?? {});
    assert.ok(labels.length >= 1 && labels.length <= 32);
    assert.match(labels[0], /^mode 1 \(.+\)$/);
    const targets = mesh.geometry.morphAttributes.position;
    assert.equal(targets.length, labels.length);
    assert.equal(targets[0].count, mesh.geometry.attributes.position.count);
  });
}
