/** Sentences about the two groups of training shapes beside chance: told apart, points, stable modes, curves. Pure. */
import type { Band, EvidenceReport, Side } from "../../worker/protocol";
import { count, length, number, percent } from "../text/format";
import { type Phrase, reported } from "../text/phrase";

/** How many left-out shapes of a group are nearer to the model of their own group. */
export function toldApartSentence(evidence: EvidenceReport, side: Side): Phrase {
  const { share, chance } = evidence.toldApart[side];
  const [own, other] = names(side);
  const shapes = evidence.shapes[side];
  const path = `evidence.toldApart.${side}`;
  const band: Phrase = [
    reported(`${path}.chance.mean`, chance.mean, percent(chance.mean)),
    " (5–95 %: ",
    reported(`${path}.chance.p05`, chance.p05, percent(chance.p05)),
    " to ",
    reported(`${path}.chance.p95`, chance.p95, percent(chance.p95)),
    ")",
  ];
  return [
    "In ",
    reported(`${path}.share`, share, String(Math.round(2 * share * shapes) / 2)),
    " of ",
    reported(`evidence.shapes.${side}`, shapes, count(shapes)),
    ` cases a left-out shape of ${own} is nearer to ${own}’s model than to ${other}’s; by chance in `,
    ...band,
    share > chance.p95
      ? `: shapes of ${own} can be told from those of ${other}.`
      : `: shapes of ${own} cannot be told from those of ${other}.`,
  ];
}

/** What the model of all others misses of a shape. */
export function leftOutSentence(evidence: EvidenceReport, unit: string): Phrase {
  const of = (side: Side): Phrase => {
    const { mean, standardDeviation } = evidence.leftOut[side];
    const path = `evidence.leftOut.${side}`;
    return [
      reported(`${path}.mean`, mean, number(mean)),
      " ± ",
      reported(`${path}.standardDeviation`, standardDeviation, length(standardDeviation, unit)),
    ];
  };
  return [
    "A shape of A lies ",
    ...of("a"),
    " from the model of the other shapes of A, one of B ",
    ...of("b"),
    " from that of B, on average over the points.",
  ];
}

/** Shares of variance at equal numbers of shapes; null for groups of one size. */
export function matchedSentence({ matched }: EvidenceReport): Phrase | null {
  if (!matched) return null;
  return [
    "With ",
    reported("evidence.matched.shapes", matched.shapes, count(matched.shapes)),
    " shapes of each group, ",
    reported(
      "evidence.matched.varianceAOutsideB",
      matched.varianceAOutsideB,
      percent(matched.varianceAOutsideB),
    ),
    " of the variance of A lies outside B, and ",
    reported(
      "evidence.matched.varianceBOutsideA",
      matched.varianceBOutsideA,
      percent(matched.varianceBOutsideA),
    ),
    " of that of B outside A.",
  ];
}

/** At how many points the means differ. */
export function pointsSentence({ vertices }: EvidenceReport): Phrase {
  const { differ, falseDiscovery } = vertices;
  const none = "The means differ at no point by more than chance (family-wise p above 0.05)";
  if (differ === 0 && falseDiscovery === 0) return [`${none}.`];
  const discovered: Phrase = [
    reported("evidence.vertices.falseDiscovery", falseDiscovery, percent(falseDiscovery)),
    " if one in twenty of these may be false.",
  ];
  if (differ === 0) return [`${none}, at `, ...discovered];
  return [
    "The means differ at ",
    reported("evidence.vertices.differ", differ, percent(differ)),
    " of the points by more than chance (family-wise p ≤ 0.05), at ",
    ...discovered,
  ];
}

/** Overlap of the first mode below which not even that is stable: half way from chance to one. */
function isStable({ overlap, dimensions }: EvidenceReport["stability"][Side]): boolean {
  return (overlap[0] ?? 0) > 0.5 * (1 + 1 / dimensions) || overlap.length === 0;
}

/** How many modes of a group halves of it have in common. */
export function stabilitySentence(evidence: EvidenceReport, side: Side): Phrase {
  const found = evidence.stability[side];
  const name = side.toUpperCase();
  const modes = found.suggestedModes;
  const number = reported(`evidence.stability.${side}.suggestedModes`, modes, count(modes));
  if (modes === 1 && !isStable(found)) {
    return [
      `No mode of ${name} is stable: halves of its shapes have other first modes. Keep at least `,
      number,
      ", and add shapes.",
    ];
  }
  const first: Phrase =
    modes === 1
      ? ["Mode ", number, ` of ${name} is stable`]
      : ["Modes 1 to ", number, ` of ${name} are stable`];
  return modes >= found.overlap.length
    ? [...first, `: as many as halves of its shapes can show.`]
    : [...first, `; from ${count(modes + 1)} on they are chance.`];
}

/** Whether an observed curve leaves the band of chance, on which side and how often. */
export function bandSentence({ observed, p05, p95 }: Band): string {
  const below = observed.filter((value, i) => value < (p05[i] ?? value)).length;
  const above = observed.filter((value, i) => value > (p95[i] ?? value)).length;
  const all = observed.length;
  if (below + above === 0) return "Inside the band of chance everywhere.";
  if (below === all) return "Below the band of chance everywhere.";
  if (above === all) return "Above the band of chance everywhere.";
  const parts = [
    ...(below > 0 ? [`below it at ${count(below)}`] : []),
    ...(above > 0 ? [`above it at ${count(above)}`] : []),
  ];
  return `Outside the band of chance at ${count(below + above)} of ${count(all)} places: ${parts.join(", ")}. By chance alone one in ten is outside.`;
}

const names = (side: Side) => (side === "a" ? (["A", "B"] as const) : (["B", "A"] as const));
