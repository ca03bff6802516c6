export function PlanesScene() {
  return <p>To come.</p>;
}
