import assert from "node:assert/strict";
import { test } from "node:test";
import { latest } from "./latest";

const settled = () => new Promise((resolve) => setImmediate(resolve));

test("one question at a time, and of those that wait only the latest", async () => {
  const asked: number[] = [];
  const answers: (() => void)[] = [];
  const ask = latest((value: number) => {
    asked.push(value);
    return new Promise<void>((resolve) => answers.push(resolve));
  });
  for (const value of [1, 2, 3]) ask(value);
  assert.deepEqual(asked, [1]);
  answers[0]?.();
  await settled();
  assert.deepEqual(asked, [1, 3]);
  answers[1]?.();
  await settled();
  ask(4);
  assert.deepEqual(asked, [1, 3, 4]);
});

test("a question that fails does not hold up the next", async () => {
  const asked: number[] = [];
  const ask = latest(async (value: number) => {
    asked.push(value);
    if (value === 1) throw new Error("no");
  });
  ask(1);
  ask(2);
  await settled();
  assert.deepEqual(asked, [1, 2]);
});
