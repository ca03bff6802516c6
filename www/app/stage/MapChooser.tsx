import { mapMode, result, slots, vertexMap } from "../state/state";
import { MAPS } from "../state/view";
import { NumberField } from "../ui/NumberField";
import { Select } from "../ui/Select";
import { MAP_WORDS } from "./map-words";
import { chooseMap } from "./maps";

/** Chooses the map that colours the vertices, and its mode. */
export function MapChooser() {
  return (
    <>
      <Select
        label="What is coloured"
        class="map-name"
        title={MAP_WORDS[vertexMap.value].help}
        value={vertexMap.value}
        options={MAPS.map((name) => [name, MAP_WORDS[name].label])}
        onChoose={chooseMap}
      />
      {vertexMap.value === "mode" && (
        <NumberField
          label="Mode"
          value={mapMode.value + 1}
          least={1}
          most={mostModes()}
          onChange={(number) => {
            if (number !== null) mapMode.value = number - 1;
          }}
        />
      )}
    </>
  );
}

/** Largest number of modes of a region; regions with fewer modes are drawn without colours. */
function mostModes(): number {
  const modes = [slots.a.value?.report.modes, slots.b.value?.report.modes];
  return Math.max(1, result.value?.report.intersection.modes ?? 1, ...modes.map((m) => m ?? 1));
}
