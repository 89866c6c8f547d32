// Light on its way: asks the program that solves for frames, and can tell it to stop.

import { decode } from './light.js';
import { count, percent, seconds } from './text.js';

/** Between an answer and the next question, milliseconds. */
const PAUSE = 250;
/** The program ends with its work: this many questions without an answer, and it is gone. */
const PATIENCE = 3;

const wait = (time) => new Promise((resolve) => { setTimeout(resolve, time); });

/** Shows frame after frame until the program ends. */
export async function follow(page) {
  const by = (id) => document.getElementById(id);
  by('live').hidden = false;
  by('live-stop').addEventListener('click', async () => {
    by('live-stop').disabled = true;
    await fetch('stop', { method: 'POST' }).catch(() => {});
  });
  let shown = 0;
  let failed = 0;
  let last = null;
  while (failed < PATIENCE && !last?.done) {
    try {
      const answer = await fetch(`light?after=${shown}`, { cache: 'no-store' });
      if (answer.status === 200) {
        const light = decode(await answer.arrayBuffer());
        shown = light.progress.frame;
        last = light.progress;
        page.show(light);
        tell(by, last);
      }
      failed = 0;
    } catch (error) {
      if (!(error instanceof TypeError)) throw error; // what fetch says of a lost connection
      failed += 1;
    }
    await wait(PAUSE);
  }
  by('live-stop').disabled = true;
  by('live-text').textContent += last?.done ? '. The light is solved.' : '. The program has ended.';
  by('live-bar').value = last?.done ? 1 : by('live-bar').value;
}

function tell(by, progress) {
  by('live-text').textContent =
    `${count(progress.elements)} elements, ${count(progress.shots)} shots, ${percent(progress.unshot)} of the emitted `
    + `power unshot, ${seconds(progress.seconds)}`;
  // On a mesh the unshot share falls from 1 to the goal, evenly in its logarithm.
  if (progress.goal > 0 && progress.goal < 1 && progress.unshot > 0) {
    by('live-bar').value = Math.min(1, Math.log(progress.unshot) / Math.log(progress.goal));
  }
}
