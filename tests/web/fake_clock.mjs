/** A clock that moves only when told, with the timers that belong to it. */
export class FakeClock {
  #time = 0;
  #timers = new Map();
  #nextId = 1;

  now = () => this.#time;

  setTimeout = (callback, delay) => {
    const id = this.#nextId++;
    this.#timers.set(id, { callback, due: this.#time + delay });
    return id;
  };

  clearTimeout = (id) => this.#timers.delete(id);

  /** Moves on, running what falls due in its order. */
  advance(time) {
    const end = this.#time + time;
    for (;;) {
      const due = [...this.#timers].filter(([, timer]) => timer.due <= end).sort(([, a], [, b]) => a.due - b.due)[0];
      if (!due) break;
      const [id, { callback, due: at }] = due;
      this.#timers.delete(id);
      this.#time = at;
      callback();
    }
    this.#time = end;
  }

  /** Time passes while nothing can run; what fell due meanwhile then runs late. */
  stall(time) {
    this.#time += time;
    for (const [id, { callback, due }] of [...this.#timers]) {
      if (due <= this.#time && this.#timers.delete(id)) callback();
    }
  }
}
