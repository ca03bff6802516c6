export function DifferenceScene() {
  return <p>To come.</p>;
}
