export function AgreeScene() {
  return <p>To come.</p>;
}
