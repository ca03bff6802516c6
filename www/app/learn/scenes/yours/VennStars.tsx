import { useSignal } from "@preact/signals";
import { still, useFrames } from "../../clock";
import { pathOf, starOf } from "../../star";

/** Time at which both tips of a star are clearly moved. */
const TELLING = 1.3;

/** Illustration of A∩B: two circles, each with a star that moves as its model can. */
export function VennStars() {
  const seconds = useSignal(TELLING);
  const playing = useSignal(!still.peek());
  useFrames(playing, (elapsed) => {
    seconds.value += elapsed / 1000;
  });
  const swing = (speed: number) => Math.sin(speed * seconds.value);
  return (
    <svg
      class="venn-stars"
      viewBox="-45 -27 90 54"
      role="img"
      aria-label="Two circles that overlap. In the left one a blue star moves its top and its lower left tip, in the right one an orange star its top and its lower right tip; where they overlap a purple star moves the top tip alone."
    >
      <circle cx="-17" r="26" class="venn-a" />
      <circle cx="17" r="26" class="venn-b" />
      <Star at={-26} whose="a" turned={[24 * swing(0.9), 0, 24 * swing(1.3)]} />
      <Star at={26} whose="b" turned={[24 * swing(1.1), 0, 0, 24 * swing(0.8)]} />
      <Star at={0} whose="ab" turned={[14 * swing(1)]} small />
    </svg>
  );
}

interface StarProps {
  at: number;
  whose: string;
  turned: readonly number[];
  small?: boolean;
}

function Star({ at, whose, turned, small = false }: StarProps) {
  const scale = small ? 0.72 : 1.3;
  return (
    <path
      d={pathOf(starOf(turned))}
      class={`venn-star-${whose}`}
      transform={`translate(${at} 0) scale(${scale})`}
    />
  );
}
