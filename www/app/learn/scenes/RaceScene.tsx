export function RaceScene() {
  return <p>To come.</p>;
}
