import type { Region } from "../../worker/protocol";
import { semiAxes } from "../ellipsoid";
import { number, signed } from "../format";
import { REGIONS } from "../link";
import { mapCaption } from "../map-words";
import { ellipsoids, pointCount, shownMap } from "../maps";
import { compared, room, unit, vertex, view } from "../state";
import { ELLIPSOID_SD } from "../viewer/contents";
import { picking } from "../viewer/stage-controller";

import { NumberField } from "./NumberField";
import { REGION_NAMES } from "./names";

/** One vertex in all five regions: chosen by its number or by a click. */
export function VertexBar() {
  const chosen = vertex.value;
  if (room.value !== "regions" || (view.value !== "sd" && chosen === null)) return null;
  return (
    <section class="vertex-bar" aria-label="Vertex">
      <div class="vertex-choice">
        <NumberField
          label={compared.value ? "Compared point" : "Vertex"}
          value={chosen}
          least={0}
          most={Math.max(0, pointCount.value - 1)}
          placeholder="number"
          onChange={(value) => {
            vertex.value = value;
          }}
        />
        <button
          type="button"
          aria-pressed={picking.value}
          onClick={() => {
            picking.value = !picking.value;
          }}
        >
          Pick vertex
        </button>
        {chosen !== null && (
          <button
            type="button"
            class="quiet"
            onClick={() => {
              vertex.value = null;
              picking.value = false;
            }}
          >
            Clear
          </button>
        )}
        {picking.value && chosen === null && <span class="small">Click on a shape.</span>}
      </div>
      {chosen !== null && <VertexTable vertex={chosen} />}
    </section>
  );
}

const ORDINALS = ["longest", "middle", "shortest"];

function VertexTable({ vertex: chosen }: { vertex: number }) {
  const map = shownMap.value;
  if (chosen >= pointCount.value) {
    return (
      <p class="small">
        There is no vertex {chosen}: these shapes have {pointCount.value} points, 0 to{" "}
        {pointCount.value - 1}.
      </p>
    );
  }
  const value = (region: Region) => map.values[region]?.[chosen];
  const axes = semiAxesOf(ellipsoids.value);
  const rows = Math.max(0, ...Object.values(axes).map((lengths) => lengths.length));
  const names = rows === 2 ? ["longest", "shortest"] : ORDINALS;
  return (
    <>
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls must be reached by keys */}
      <section class="vertex-table" tabIndex={0} aria-label="Figures of the vertex">
        <table class="numbers">
          <caption class="unseen">Vertex {chosen} in the five regions</caption>
          <thead>
            <tr>
              <th scope="col">
                <span class="unseen">Figure</span>
              </th>
              {REGIONS.map((region) => (
                <th key={region} scope="col">
                  {REGION_NAMES[region].sign}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            <tr>
              <th scope="row">{mapCaption(map.name, map, unit.value)}</th>
              {REGIONS.map((region) => (
                <Cell key={region} value={value(region)} show={map.signed ? signed : number} />
              ))}
            </tr>
            {Array.from({ length: rows }, (_, i) => (
              <tr key={names[i]}>
                <th scope="row">
                  Ellipsoid, {names[i]} semi-axis at {ELLIPSOID_SD} SD, {unit.value}
                </th>
                {REGIONS.map((region) => (
                  <Cell key={region} value={axes[region]?.[i]} show={number} />
                ))}
              </tr>
            ))}
          </tbody>
        </table>
      </section>
      {rows > 0 && (
        <p class="small">
          The {rows === 2 ? "ellipse" : "ellipsoid"} in each pane is the covariance of this vertex
          there, about its mean place, drawn at {ELLIPSOID_SD} SD.
        </p>
      )}
    </>
  );
}

function semiAxesOf(found: typeof ellipsoids.value): Partial<Record<Region, number[]>> {
  const lengths: Partial<Record<Region, number[]>> = {};
  for (const region of REGIONS) {
    const ellipsoid = found[region];
    if (ellipsoid) lengths[region] = semiAxes(ellipsoid, ELLIPSOID_SD);
  }
  return lengths;
}

interface CellProps {
  value: number | undefined;
  show: (value: number) => string;
}

function Cell({ value, show }: CellProps) {
  if (value === undefined) {
    return (
      <td>
        <span class="dim">–</span>
      </td>
    );
  }
  return (
    <td>
      <data value={String(value)}>{show(value)}</data>
    </td>
  );
}
