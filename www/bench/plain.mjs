// The baseline: the same Euler step on one lane, as one writes it in JavaScript with typed arrays.

/** Equal drivers at equal headways (m), the first nudged by 1 m; Δ in steps. */
export class Plain {
  constructor(vehicles, delay, { headway = 20, maxSpeed = 40, sensitivity = 1, minHeadway = 7.5, timeStep = 0.01 } = {}) {
    // Row by row, displacements of the last `delay` steps and of now.
    const data = new Float64Array((delay + 1) * vehicles)
    this.rows = Array.from({ length: delay + 1 }, (_, i) => data.subarray(i * vehicles, (i + 1) * vehicles))
    for (const row of this.rows) row[0] = 1
    this.head = 0
    this.headway = headway
    this.maxSpeed = maxSpeed
    this.rate = -sensitivity / maxSpeed
    this.minHeadway = minHeadway
    this.timeStep = timeStep
  }

  step(steps) {
    for (let i = 0; i < steps; i++) {
      const next = this.head + 1 === this.rows.length ? 0 : this.head + 1
      advance(this.rows[this.head], this.rows[next], this.headway - this.minHeadway, this.rate, this.maxSpeed, this.timeStep)
      this.head = next
    }
  }

  displacements() {
    return this.rows[this.head]
  }
}

/** `row` holds what was seen Δ ago, and gets the positions after the step. */
function advance(now, row, gap, rate, maxSpeed, timeStep) {
  const last = now.length - 1
  const first = row[0]
  let own = first
  for (let j = 0; j <= last; j++) {
    const lead = j < last ? row[j + 1] : first
    const speed = maxSpeed - maxSpeed * Math.exp(rate * (gap + (lead - own)))
    row[j] = now[j] + (speed > 0 ? speed * timeStep : 0)
    own = lead
  }
}
