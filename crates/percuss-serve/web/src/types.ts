// Types of the responses of the server.

export interface Unit { symbol: string; factor: number; offset: number }

export interface Field {
  key: string;
  help: string;
  default: string | null;
  kind: "material" | "quantity" | "number" | "boolean" | "choice" | "text";
  units?: Unit[];
  usual?: string;
  words?: string[];
  integer?: boolean;
  choices?: string[];
  common: boolean;
  nested: boolean;
  alternative: boolean;
  slider: [number, number] | null;
}

export interface Axis { label: string; log: boolean; downward: boolean; range: [number, number] | null; names?: string[] }

export interface Series {
  name: string;
  color: string;
  dashes: string | null;
  line: boolean;
  markers: boolean;
  width: number;
  x?: (number | null)[];
  y: (number | null)[];
  errors?: [number, number][];
  band?: [number | null, number | null][];
}

export interface Mark { name: string; value: number; vertical: boolean }

interface ChartHead { name: string; title: string; caption: string; x: Axis; y: Axis }
export interface LineChart extends ChartHead { kind: "lines"; series: Series[]; marks: Mark[]; true_to_scale: boolean }
export interface AreaChart extends ChartHead {
  kind: "areas";
  positions: number[];
  areas: { name: string; color: string; heights: number[] }[];
}
export interface MapChart extends ChartHead {
  kind: "map";
  columns: number;
  cells: string;
  colors: string[];
  no_value: string;
  value_label: string;
  ends: [number, number];
  vertical_lines: number[];
}
export interface RowChart extends ChartHead {
  kind: "rows";
  rows: { name: string; color: string; value: number; range: [number, number] | null; words?: string }[];
  marks: Mark[];
}
export interface HistogramChart extends ChartHead {
  kind: "histogram";
  middles: number[];
  width: number;
  parts: number[];
  color: string;
  marks: Mark[];
}
export interface Bar { ends: [number, number]; color: string; lane: number; interval: [number, number] | null; text: string }
export interface BarChart extends ChartHead {
  kind: "bars";
  lanes: number;
  rows: { name: string; bars: Bar[] }[];
  colors: [string, string][];
  marks: Mark[];
}
export type Chart = LineChart | AreaChart | MapChart | RowChart | HistogramChart | BarChart;

export type Value = string | boolean | { number: string };
export type Values = Record<string, Value>;
export type Row = [string, string];

export interface Result {
  model: string;
  outcome: string;
  reason: string | null;
  warnings: string[];
  band: { quantity: string; low: number; high: number; basis: string } | null;
  expected_error: { median: number; low: number; high: number; cases: number; outside: boolean } | null;
  [quantity: string]: unknown;
}

export interface Answer {
  case: string;
  values: Values;
  constants: { key: string; value: string }[];
  // Values of keys that the case leaves out, where they depend on it.
  in_use: Record<string, string>;
  model: string;
  results: { case: string; percuss_version: string; results: Result[] };
  rows: [Row[], Row[], Row[]];
  charts: Chart[];
  elapsed_ms: number;
}

export interface Problem {
  message: string;
  help: string;
  key: string;
  place: { line: number; text: string; column: number; length: number } | null;
}

export interface Study {
  charts: Chart[];
  pictures: { name: string; title: string; svg: string }[];
  files: Record<string, string>;
}

export interface Comparison extends Study {
  regimes: string[];
  quantities: { key: string; words: string; unit: string; measured: number | null }[];
  comparison: {
    regime: { impact_velocity_m_s: number }[];
    recommended: { models: { model: string; because: string }[]; note: string | null }[];
    experiments: { sources: string[] }[];
    results: Result[];
  };
}

export interface Convergence extends Study {
  words: string[];
  study: {
    meshes: { projectile_elements: number; target_elements: number; steps: number }[];
    quantities: {
      name: string;
      unit: string;
      values: number[];
      status: { kind: string; order?: number; richardson?: number; index?: number };
    }[];
  };
}

export interface Limits extends Study {
  headline: string | null;
  axisymmetric: string | null;
  measured: number | null;
  outcomes: string[];
  // Whether the case fixes the rear face, which is free here.
  freed: boolean;
  rear_face: string | null;
  expected: (string | null)[];
  limits: {
    recommended: { model: string; because: string }[];
    note: string | null;
    range: { lowest_m_s: number; highest_m_s: number; models: number } | null;
    axisymmetric: {
      reason: string | null;
      warnings: string[];
      ballistic_limit_m_s: number | null;
      uncertainty_m_s: number | null;
      meshes: { runs: number }[];
    } | null;
    results: {
      model: string;
      outcome: string;
      reason: string | null;
      ballistic_limit_m_s: number | null;
      bracket: { stopped_m_s: number; perforated_m_s: number } | null;
      runs: number;
    }[];
  };
}

interface Estimate { value: number; low: number; high: number }
interface Perforation { perforated: number; stopped: number; probability: number; low: number; high: number }

export interface Spread extends Study {
  quantities: { words: string; unit: string }[];
  labels: string[];
  nominal: string;
  caution: string;
  uncertainty: {
    model: string;
    samples: number;
    seed: number;
    runs: number;
    inputs: { key: string; distribution: string }[];
    nominal: { reason: string | null; warnings: string[] };
    failures: { runs: number; reasons: string[] };
    perforation: Perforation | null;
    quantities: {
      nominal: number | null;
      statistics: { runs: number; mean: number; standard_error: number; standard_deviation: number; percentiles: { percent: number; value: number }[] };
      tornado: { key: string; at_low: number | null; at_high: number | null }[];
      indices: { parameters: { key: string; first_order: Estimate; total: Estimate }[] } | null;
      no_indices: string | null;
    }[];
    no_indices: string | null;
    warnings: string[];
  };
}

export interface Swept extends Study {
  model: string;
  design: string;
  runs: number;
  parameters: { label: string; words: string[] }[];
  outcomes: Record<string, number>;
  reasons: string[];
  numbers: { quantity: string; label: string; values: (number | null)[] }[];
  rows: { inputs: number[]; outcome: string; reason: string }[];
  drawn: { quantity: string; style: string; chart: Chart }[];
}

export interface Marginal {
  quantiles: [number, number, number];
  r_hat: number;
  bulk_effective_size: number;
  tail_effective_size: number;
}
export interface Quality { count: number; rms_before: number | null; rms: number; bias: number; inside: number | null }

export interface CurveError { rms_difference: number; relative_rms_difference: number | null }

export interface Calibrated extends Study {
  labels: string[];
  material: string | null;
  calibration: {
    model: string;
    seed: number;
    runs: number;
    parameters: {
      key: string;
      unit: string;
      prior: [number, number, number];
      best: number;
      standard_error: number | null;
      posterior: Marginal | null;
    }[];
    scatter: { estimated: boolean; best: number; posterior: Marginal | null };
    findings: { words: string }[];
    training: Quality | null;
    hold_out: Quality | null;
    sampling: { ensembles: number; walkers: number; steps: number; burn_in: number } | null;
    warnings: string[];
    predictions: {
      id: string;
      held_out: boolean;
      quantity: string;
      unit: string;
      impact_velocity_m_s: number;
      measured: number;
      before: number | null;
      best: number | null;
      predictive_band: [number, number] | null;
    }[];
    curves: {
      id: string;
      held_out: boolean;
      unit: string;
      values: number;
      effective_values: number;
      correlation_time_us: number;
      before: CurveError | null;
      best: CurveError | null;
    }[];
    left_out: { id: string; reason: string }[];
  };
}

// Messages of the axisymmetric answer that refines itself.
export interface FieldQuantity { name: string; label: string; colors: string[]; bare: number }
export interface Plan {
  cells: number[];
  words: string;
  wall: string | null;
  edge: string;
  bodies: string[];
  quantities: FieldQuantity[];
  colors: { axisymmetric: string; beside: string };
}
export interface FrameHead {
  cells: number;
  number: number;
  first: boolean;
  dropped: number[];
  time_us: number;
  depth_mm: number;
  cell_mm: number;
  bodies: { particles: number; mass_kg: number }[];
  scales: [number, number][];
  ranges: [number, number][];
  own_ranges: [number, number][];
  view: { radius_mm: number; depth_mm: [number, number] };
}
export interface Refined {
  cells: number;
  quantity: string;
  unit: string;
  meshes: [number, number | null][];
  value: number | null;
  uncertainty: number | null;
  headline: [string, string] | null;
  rows: Row[];
  reason: string | null;
  note: string | null;
}
export interface RefinementMessage {
  plan?: Plan;
  refused?: { reason: string; remedy: string | null };
  progress?: { cells: number; fraction: number };
  frame?: FrameHead;
  answer?: Refined;
  problem?: Problem;
  done?: true;
}

export interface Start {
  version: string;
  name: string;
  answer: Answer;
  fields: Field[];
  models: { name: string; summary: string; slow: boolean }[];
  materials: { id: string; name: string; family: string | null; recommended: boolean; trust: string; sources: string[]; words: string }[];
  cases: { name: string; title: string; text: string }[];
  bounds: { elements: number; seconds: number };
  experiment_color: string;
}
