// Colours of the server's palette on a dark ground: as distinct as on white, and light enough to be seen.

const dark = matchMedia("(prefers-color-scheme: dark)");

export function onThemeChange(action: () => void): void {
  dark.addEventListener("change", action);
}

export function color(hex: string): string {
  if (!dark.matches || !/^#[0-9a-f]{6}$/i.test(hex)) return hex;
  const channels = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);
  const [high, low] = [Math.max(...channels), Math.min(...channels)];
  // Greys change places: ink is light on a dark ground.
  if (high - low < 0.08) return `rgb(${channels.map((c) => Math.round(255 * (0.92 - 0.55 * c))).join(" ")})`;
  const lightness = (high + low) / 2;
  const mix = Math.max(0, (0.62 - lightness) / (1 - lightness));
  return `rgb(${channels.map((c) => Math.round(255 * (c + (1 - c) * mix))).join(" ")})`;
}

export function variable(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

export function fade(css: string, opacity: number): string {
  return `color-mix(in srgb, ${css} ${Math.round(100 * opacity)}%, transparent)`;
}
