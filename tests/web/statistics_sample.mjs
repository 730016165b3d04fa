/** An answer of `/statistics.json` with three visitors, as a server with two cores gives it. */
export function sample() {
  const type = (i, b, f, across, each) => ({
    c_i_ms: i,
    c_b_ms: b,
    c_f_ms: f,
    alpha: i / (i + b + f),
    beta: across / (across + each),
    across_user_mb: across,
    per_visitor_mb: each,
  });
  const stage = (work, runs, cpu) => ({ work, runs, failures: 0, cpu_ms: cpu, wall_ms: 2 * cpu });
  return {
    version: '1.2.3',
    visitors: 3,
    stages: {
      Compositor: stage('per-user-frontend', 9000, 8100),
      Encoder: stage('per-user-frontend', 2700, 7020),
      Renderer: stage('per-user-backend', 27000, 10800),
      'Simulation Tick': stage('across-user', 900, 4500),
    },
    counters: { 'view cache hits': 5200, 'view cache misses': 700, 'views too near to share': 100 },
    quality: { step: 0, steps: 3, automatic: false },
    memory: {
      resident_mb: 1439.2,
      told_mb: 1012.4,
      holders: [
        { holder: 'shared views', type: 'lightfield', work: 'on-demand', mb: 210.3 },
        { holder: 'light fields', type: 'lightfield', work: 'across-user', mb: 752.1 },
        { holder: 'targets', type: '', work: 'per-user-frontend', mb: 50 },
      ],
    },
    amortization: {
      mode: 'shared',
      seconds: 5.04,
      visitors: 3,
      frames_per_second: 29.9,
      ...type(14.5, 3, 5.5, 962.4, 16.7),
      c_i_on_demand_ms: 4,
      c_b_on_demand_ms: 1,
      reuse: { views_made: 50, views_of_one: 30, views_of_several: 20, uses_again: 350, uses_by_others: 100 },
      other_ms: 0.7,
      private_frame_ms: 24.4,
      cpu_cores: 1.31,
      cores: 2,
      visitor_cores: 0.29,
      visitors_fit: 5,
      private_cores: 2.2,
      private_visitors_fit: 2,
      types: {
        '': type(0.5, 0.2, 3.1, 0, 16.7),
        fluid: type(9, 0.1, 1.1, 40.2, 0),
        lightfield: type(5, 2.7, 1.3, 922.2, 0),
      },
    },
  };
}
