import type { Region } from "../../worker/protocol";
import { REGIONS } from "../state/regions";
import { compared, slots, tab, unit, vertex, view } from "../state/state";
import { number, signed, withoutRoundingError } from "../text/format";
import { NumberField } from "../ui/NumberField";
import { ELLIPSOID_SD } from "../viewer/contents";
import { semiAxes } from "./ellipsoid";
import { MAP_WORDS, mapCaption, mapUnit } from "./map-words";
import { ellipsoids, pointCount, shownMap } from "./maps";
import { REGION_NAMES } from "./names";
import { picking } from "./stage-controller";

/** Numbers of one vertex in all five regions; it is chosen by its number or by a click. */
export function VertexBar() {
  const chosen = vertex.value;
  if (tab.value !== "regions" || (view.value !== "sd" && chosen === null)) return null;
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
        <span class="small">{explanation()}</span>
      </div>
      {chosen !== null && <VertexTable vertex={chosen} />}
    </section>
  );
}

function explanation(): string {
  if (vertex.value === null) return picking.value ? "Click on a shape." : "";
  const [found] = Object.values(ellipsoids.value);
  if (!found) return "";
  const name = found.centre.length === 2 ? "Ellipses" : "Ellipsoids";
  return `${name}: covariance of this vertex in each region, drawn at ${ELLIPSOID_SD} SD.`;
}

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
  const size = slots.a.value?.report.size ?? 0;
  const length = (value: number) => number(withoutRoundingError(value, size));
  const show = (value: number) => (map.signed ? signed : number)(withoutRoundingError(value, size));
  const axes = semiAxesOf(ellipsoids.value);
  const rows = Math.max(0, ...Object.values(axes).map((lengths) => lengths.length));
  return (
    <>
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls must be reached by keys */}
      <section class="vertex-table" tabIndex={0} aria-label="Numbers of the vertex">
        <table class="numbers">
          <caption class="unseen">Vertex {chosen} in the five regions</caption>
          <thead>
            <tr>
              <th scope="col">
                <span class="unseen">Quantity</span>
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
              <th scope="row" title={mapCaption(map.name, map, unit.value)}>
                {MAP_WORDS[map.name].label}, {mapUnit(map.name, unit.value)}
              </th>
              {REGIONS.map((region) => (
                <Cell
                  key={region}
                  value={value(region)}
                  show={map.name === "ratio" ? signed : show}
                />
              ))}
            </tr>
            {rows > 0 && (
              <tr>
                <th scope="row">
                  Semi-axes at {ELLIPSOID_SD} SD, {unit.value}
                </th>
                {REGIONS.map((region) => (
                  <Lengths key={region} values={axes[region] ?? []} show={length} />
                ))}
              </tr>
            )}
          </tbody>
        </table>
      </section>
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

/** Semi-axes of one ellipsoid, longest first. */
function Lengths({ values, show }: { values: number[]; show: (value: number) => string }) {
  return (
    <td>
      {values.length === 0 && <span class="dim">–</span>}
      {values.map((value, i) => (
        <span key={String(i)}>
          {i > 0 && "\u200a×\u200a"}
          <data value={String(value)}>{show(value)}</data>
        </span>
      ))}
    </td>
  );
}
