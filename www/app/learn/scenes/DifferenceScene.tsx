import { useEffect, useMemo, useRef } from "preact/hooks";
import { letters } from "../../state/regions";
import { Segments } from "../../ui/Segments";
import { useFrames } from "../clock";
import { useSceneKeys } from "../keys";
import { PlayBar } from "../parts/controls";
import {
  AnyPairChoice,
  CountSlider,
  SeedField,
  SideChoice,
  SigmaSlider,
} from "../sampling/Controls";
import { useSession } from "../sampling/session";
import { params, resetScene, setParams } from "../state";
import type { DifferenceValues } from "./difference/asks";
import { Numbers } from "./difference/Numbers";
import { Cut, Plane } from "./difference/Pictures";
import { Questions } from "./difference/Questions";
import { DifferenceRun } from "./difference/run";
import { ShareChart } from "./difference/ShareChart";
import "./samplers.css";

const STAR_SIGMA = 0.03;

/** Scene about the difference: shapes of one model that the other cannot make, by 1 − L_D. */
export function DifferenceScene() {
  const run = useMemo(() => new DifferenceRun(), []);
  const values = params("difference").value;
  const { pair, sigma, side, seed, draws, flipped } = values;
  const isFirst = useRef(true);
  const mine = useRef(flipped);
  useSession([pair, sigma, side, seed, draws].join(), async (ask) => {
    // The introduction is animated only on arrival, not after a change of a setting or with a link that has one.
    const told = isFirst.current && !flipped;
    if (isFirst.current) run.show(flipped);
    isFirst.current = false;
    await run.open(ask, params("difference").peek(), told);
  });
  useEffect(() => {
    if (mine.current !== flipped) run.show(flipped);
    mine.current = flipped;
  }, [flipped]);
  useFrames(run.moving, (elapsed) => run.frame(elapsed));
  const change = (part: Partial<DifferenceValues>) => setParams("difference", part);
  const turn = (to: boolean) => {
    mine.current = to;
    run.turn(to);
    change({ flipped: to });
  };
  const toggle = () => run.toggleRain();
  useSceneKeys(toggle, () => turn(!run.flipped.peek()));
  const [own, other] = letters(side);
  return (
    <>
      <p class="lead">
        What can {own} make that {other} <em>cannot</em>? Replace the likelihood Lᴅ by 1 − Lᴅ: where
        Lᴅ is near one, 1 − Lᴅ is near zero. The ridge of the density becomes a hole.
      </p>
      <div class="scene-bar">
        <Segments
          legend="Likelihood"
          name="difference-flip"
          value={run.flipped.value ? "flipped" : "plain"}
          options={[
            ["plain", `Lᴅ: ${other} can too`],
            ["flipped", `1 − Lᴅ: ${other} cannot`],
          ]}
          onChoose={(option) => turn(option === "flipped")}
        />
        <PlayBar playing={run.raining.value} onToggle={toggle} onReset={resetScene} />
        <SigmaSlider
          value={sigma}
          least={0.003}
          most={3}
          onChange={(next) => change({ sigma: next })}
        />
      </div>
      <div class="scene-body">
        <Plane run={run} side={side} />
        <div class="scene-side">
          <Cut run={run} />
          <Numbers run={run} own={own} other={other} side={side} />
          <ShareChart shares={run.shares.value} sigma={sigma} own={own} other={other} />
        </div>
      </div>
      <div class="scene-settings">
        <CountSlider
          label="Draws"
          most={5000}
          value={draws}
          onChange={(next) => change({ draws: next })}
        />
        <AnyPairChoice value={pair} starSigma={STAR_SIGMA} onChange={change} />
        <SideChoice value={side} onChange={(next) => change({ side: next })} />
        <SeedField value={seed} onChange={(next) => change({ seed: next })} />
      </div>
      <Questions />
    </>
  );
}
