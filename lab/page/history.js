// Keeps every bat there was, so that each step can be undone and done again without end.

/** Steps of undo: whole bat files as text, and which of them is shown. */
export class History {
  /** @param {string} first */
  constructor(first) {
    /** @type {string[]} */
    this.steps = [first];
    this.place = 0;
    /** The places of the bats that were opened. */
    this.openings = [0];
  }

  get now() { return this.steps[this.place]; }
  /** The bat as it was opened: what is compared with unless told otherwise. */
  get opened() { return this.steps[this.openings.findLast((place) => place <= this.place)]; }
  get before() { return this.place > 0 ? this.steps[this.place - 1] : null; }
  get canUndo() { return this.place > 0; }
  get canRedo() { return this.place < this.steps.length - 1; }

  /** One step more; what was undone before is gone. A step that changes nothing is none. */
  push(text) {
    if (text === this.now) return false;
    this.steps.length = this.place + 1;
    this.openings = this.openings.filter((place) => place <= this.place);
    this.steps.push(text);
    this.place += 1;
    return true;
  }

  undo() { if (this.canUndo) this.place -= 1; return this.now; }
  redo() { if (this.canRedo) this.place += 1; return this.now; }

  /** Another bat: one step like any, and the one that differences now count from. */
  open(text) {
    this.push(text);
    if (!this.openings.includes(this.place)) this.openings.push(this.place);
  }
}
