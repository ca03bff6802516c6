/** Files that leave open how they are read: what is found is said on the card, and one click takes another reading. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { card, dropFiles, openLink, untilState, withPage } from "./harness.mjs";

/** A set of eight wobbling decagons as TPS; some of its points are not there, some specimens are mirrored. */
function landmarks({ missing = [], mirrored = [] }) {
  const lines = [];
  for (let specimen = 0; specimen < 8; specimen += 1) {
    lines.push("LM=10");
    for (let point = 0; point < 10; point += 1) {
      const angle = (point * Math.PI) / 5;
      const radius =
        100 + 30 * Math.sin(2 * angle + 1) + 4 * Math.sin((specimen + 2) * (point + 1));
      const [x, y] = [radius * Math.cos(angle), radius * Math.sin(angle)].map((to) => to + 500);
      const gone = missing.some(([at, of]) => at === specimen && of === point);
      lines.push(gone ? "-1 -1" : `${mirrored.includes(specimen) ? -x : x} ${y}`);
    }
    lines.push(`ID=${specimen}`);
  }
  return Buffer.from(`${lines.join("\n")}\n`);
}

test("missing landmarks are named with what can be left out, and a click opens the rest", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=stars-1&draws=64&perms=0");
    const set = landmarks({
      missing: [
        [2, 5],
        [6, 3],
      ],
    });
    await dropFiles(page, "body", [{ name: "set.tps", bytes: set }]);
    const alert = card(page, "A").getByRole("alert");
    await alert.waitFor();
    const message = await alert.locator(".notice-message").innerText();
    assert.match(message, /2 landmarks are missing in 2 of 8 specimens: landmark 6 of specimen 3/);
    await alert.getByRole("button", { name: "Leave out 2 specimens" }).click();
    await card(page, "A").getByText("Computed here from 6 shapes").waitFor();
    const chip = card(page, "A").getByText("Specimens with missing landmarks were left out.");
    await chip.waitFor();
    await untilState(page, ["done", "failed", "incomparable"]).catch(() => {});
    await page.waitForFunction(() => location.hash.includes("read-a=missing"));
    // Taken back, the specimens are missed again, and the model that is open stays.
    await card(page, "A")
      .getByRole("button", { name: /^Undo: Specimens with missing/ })
      .click();
    await alert.waitFor();
    assert.equal(await chip.count(), 1, "the model that is open stays");
  });
});

test("mirrored specimens are named, and mirrored on a click", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=stars-1&draws=64&perms=0");
    const files = [{ name: "set.tps", bytes: landmarks({ mirrored: [1, 4] }) }];
    await dropFiles(page, "body", files);
    const finding = card(page, "A").locator('[data-code="mirrored"]');
    await finding.waitFor();
    assert.match(await finding.innerText(), /Specimen 2 and specimen 5 fit the other specimens/);
    await finding.getByRole("button", { name: "Mirror them" }).click();
    await card(page, "A").getByText("Specimens mirrored: 2, 5.").waitFor();
    assert.equal(await finding.count(), 0, "nothing is unusual any more");
    await page.waitForFunction(() => location.hash.includes("read-a=mirror"));
  });
});
