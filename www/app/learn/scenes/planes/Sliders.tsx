import { number } from "../../../text/format";
import { bounded } from "../../params";
import { Slider } from "../../parts/controls";
import { SCENE_PARAMS, type SceneValues } from "../../scenes";
import { setParams } from "../../state";

const SCHEMA = SCENE_PARAMS.planes;
const signedText = (value: number) => `${value < 0 ? "−" : "+"}${Math.abs(value).toFixed(2)}`;
const set = (part: Partial<SceneValues<"planes">>) => setParams("planes", part);

type Arrangement = Pick<SceneValues<"planes">, "sigma" | "tilt" | "shift" | "lift">;

/** Sliders for the position of the planes and for σ. */
export function Sliders({ sigma, tilt, shift, lift }: Arrangement) {
  return (
    <div class="planes-sliders">
      <Slider
        label="σ (how near)"
        value={sigma}
        least={0.03}
        most={3}
        step={0}
        logarithmic
        show={(value) => number(value, 2)}
        onChange={(value) => set({ sigma: bounded(SCHEMA.sigma, Number(value.toPrecision(2))) })}
      />
      <Slider
        label="Angle between"
        value={tilt}
        least={0}
        most={90}
        step={1}
        show={(value) => `${value}°`}
        onChange={(value) => set({ tilt: value })}
      />
      <Slider
        label="B along the line"
        value={shift}
        least={-2}
        most={2}
        step={0.05}
        show={signedText}
        onChange={(value) => set({ shift: bounded(SCHEMA.shift, value) })}
      />
      <Slider
        label="B off A’s plane"
        value={lift}
        least={-1.5}
        most={1.5}
        step={0.05}
        show={signedText}
        onChange={(value) => set({ lift: bounded(SCHEMA.lift, value) })}
      />
    </div>
  );
}
