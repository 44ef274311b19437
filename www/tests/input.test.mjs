// Bad input: it is answered by a sentence where it was made, and the state before it stays.
import { mkdtempSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { csv, equal, holds, playTo, ready, snapshot, test } from './helpers.mjs'

test('a bad link is reported entry by entry and the rest applies', async ({ open }) => {
  const page = await open('index.html#colour=red&vehicles=30&reaction-time=99&action=at%3D5%3A80%3Abrake%3D1&sensitivity=1.5')
  await ready(page)
  const { scenario } = await snapshot(page)
  equal([scenario.vehicles, scenario.driver.sensitivity, scenario.driver.reaction_time].join(), '30,1.5,0', 'what applies')
  const items = await page.locator('#trouble li').allTextContents()
  equal(items.length, 3, `messages ${items}`)
  for (const [k, word] of ['colour', '99', '80'].entries()) holds(items.some(i => i.includes(word)), `no message about ${word} (${k})`)
})

test('a hash typed into the address opens another experiment', async ({ open }) => {
  const page = await open('index.html#vehicles=20')
  await ready(page)
  await page.evaluate(() => {
    location.hash = '#vehicles=25'
  })
  await page.waitForFunction(() => window.ringroad.snapshot.scenario.vehicles === 25)
})

test('problems and the note of an experiment disappear when something else is opened', async ({ open }) => {
  const page = await open('index.html', { reducedMotion: 'reduce' })
  await ready(page)
  const others = {
    file: async () => {
      await page.click('#open-files')
      await page.setInputFiles('#file', { name: 'forty.json', mimeType: 'application/json', buffer: Buffer.from('{"vehicles": 40}') })
      await page.keyboard.press('Escape')
    },
    link: () => page.evaluate(() => void (location.hash = '#vehicles=40')),
  }
  for (const [name, other] of Object.entries(others)) {
    await page.selectOption('#presets', 'stable')
    await page.waitForSelector('#preset:not([hidden])')
    await page.evaluate(() => window.ringroad.set('vehicles', '300'))
    await page.waitForSelector('#trouble:not([hidden])')
    equal(await page.inputValue('#presets'), 'stable', 'the list of experiments')
    await other()
    await page.waitForFunction(() => window.ringroad.snapshot.scenario.vehicles === 40)
    for (const id of ['trouble', 'preset']) await page.waitForSelector(`#${id}`, { state: 'hidden' })
    equal(await page.inputValue('#presets'), '', `the list of experiments after a ${name}`)
  }
  await page.evaluate(() => window.ringroad.set('vehicles', '300'))
  await page.waitForSelector('#trouble:not([hidden])')
  await page.selectOption('#presets', 'three-lanes')
  await page.waitForSelector('#trouble', { state: 'hidden' })
  holds((await page.textContent('#preset')).startsWith('Three lanes.'), await page.textContent('#preset'))
})

test('an action without its car, and any action after a crash, is refused with a sentence', async ({ open }) => {
  const page = await open('index.html#reaction-time=1.2&action=at%3D0%3A1%3Anudge%3D1', { reducedMotion: 'reduce' })
  await ready(page)
  await page.click('#tab-actions')
  await page.fill('#do', 'brake=3')
  await page.press('#do', 'Enter')
  await page.waitForSelector('#trouble:not([hidden])')
  const asked = await page.textContent('#trouble li')
  holds(asked.includes('“brake=3”') && asked.includes('WHO:EFFECT') && !asked.includes('at='), asked)
  await page.evaluate(() => window.ringroad.seek(200))
  holds(await page.evaluate(() => window.ringroad.frame.collision), 'no crash')
  holds((await page.isDisabled('#nudge')) && (await page.isDisabled('#brake')), 'buttons that can only be refused')
  await page.evaluate(() => document.activeElement.blur())
  await page.keyboard.press('b')
  await page.waitForSelector('#trouble:not([hidden])')
  holds((await page.textContent('#trouble li')).includes('go back'), await page.textContent('#trouble li'))
  await page.evaluate(() => window.ringroad.seek(5))
  holds(await page.isEnabled('#brake'), 'a brake that stays shut')
})

test('after a crash Play is disabled, and its keys say why the run does not go on', async ({ open }) => {
  const page = await open('index.html#reaction-time=1.2&action=at%3D0%3A1%3Anudge%3D1', { reducedMotion: 'reduce' })
  await ready(page)
  const colour = () => page.evaluate(() => getComputedStyle(document.querySelector('#play')).backgroundColor)
  const before = await colour()
  await page.evaluate(() => window.ringroad.seek(200))
  holds(await page.isDisabled('#play'), 'Play after a crash')
  holds((await colour()) !== before, `Play is ${before} still`)
  await page.evaluate(() => document.activeElement.blur())
  for (const key of ['Space', '.']) {
    await page.keyboard.press(key)
    await page.waitForSelector('#trouble:not([hidden])')
    holds((await page.textContent('#trouble li')).includes('go back'), await page.textContent('#trouble li'))
    await page.click('#trouble button')
    await page.evaluate(() => document.activeElement.blur())
  }
})

test('an experiment that is changed is no longer shown as that experiment', async ({ open }) => {
  const page = await open('index.html', { reducedMotion: 'reduce' })
  await ready(page)
  const changes = {
    setting: () => page.evaluate(() => window.ringroad.set('reaction_time', '0.75')),
    action: () => page.click('#nudge'),
  }
  for (const [name, change] of Object.entries(changes)) {
    await page.selectOption('#presets', 'stable')
    await page.waitForSelector('#preset:not([hidden])')
    await playTo(page, 20)
    for (const again of [() => window.ringroad.seek(5), () => window.ringroad.restart(true), () => window.ringroad.restart(false)]) await page.evaluate(again)
    await playTo(page, 5)
    equal(await page.inputValue('#presets'), 'stable', 'the list of experiments while it plays')
    holds(await page.isVisible('#preset'), 'the note went while it plays')
    await change()
    await page.waitForSelector('#preset', { state: 'hidden' })
    equal(await page.inputValue('#presets'), '', `the list of experiments after a ${name}`)
  }
})

test('fields of the tabs and of the data say what they take', async ({ open }) => {
  const page = await open('index.html', { reducedMotion: 'reduce' })
  await ready(page)
  await page.click('#tab-car')
  for (const bad of ['99', '0', '2.5']) {
    await page.fill('#car-number', bad)
    await page.press('#car-number', 'Enter')
    equal(await page.textContent('#car-wrong'), 'Vehicle: a whole number from 1 to 50', `vehicle ${bad}`)
  }
  await page.fill('#car-number', '7')
  await page.press('#car-number', 'Enter')
  holds(!(await page.isVisible('#car-wrong')), 'a complaint about vehicle 7')
  equal(await page.evaluate(() => window.ringroad.watched), 6, 'watched')
  await page.fill('#own-reaction_time', '99')
  await page.press('#own-reaction_time', 'Enter')
  equal(await page.textContent('#own-reaction_time-wrong'), 'Reaction time: a number from 0 to 10 s', 'its own')
  equal((await snapshot(page)).scenario.actions.length, 1, 'actions')
  await page.click('#open-files')
  await page.fill('#every', '')
  await page.click('#show-csv')
  equal(await page.textContent('#every-wrong'), 'A row every: a number from 0.001 to 10000000 s', 'a row every')
  await page.fill('#every', '0.5')
  holds(!(await page.isVisible('#every-wrong')), 'a complaint about half a second')
  await page.click('#show-csv')
  await page.waitForSelector('#export-text:not([hidden])')
})

test('arrows go back to the value that was opened; unchanged parameters have none', async ({ open }) => {
  const page = await open('index.html', { reducedMotion: 'reduce' })
  await ready(page)
  await page.click('#more-controls')
  const back = page.locator('.control .back:visible')
  equal(await back.count(), 0, 'arrows on an unchanged page')
  for (const [field, value] of [['#p-until', '300'], ['#p-reaction_time-number', '0.5']]) {
    const first = await page.inputValue(field)
    await page.fill(field, value)
    await page.press(field, 'Enter')
    await back.click()
    await page.waitForFunction(([field, first]) => document.querySelector(field).value === first, [field, first])
    equal(await back.count(), 0, 'arrows after going back')
  }
  await page.selectOption('#presets', 'stable')
  await page.waitForSelector('#preset:not([hidden])')
  equal(await back.count(), 0, 'arrows at an experiment')
})

test('a bad file leaves the run as it is; good files open', async ({ open }) => {
  const page = await open('index.html#vehicles=33')
  await ready(page)
  await playTo(page, 10)
  const step = await page.evaluate(() => window.ringroad.frame.step)
  const folder = mkdtempSync(join(tmpdir(), 'ringroad-'))
  await page.click('#open-files')
  for (const [name, content, words] of [
    ['broken.json', '{"vehicles": 12', ['JSON']],
    ['wrong.json', '{"vehicles": 1e9}', ['vehicles', '1000000']],
    ['photo.json', '\u0000\u0001PNG', ['JSON']],
    ['other.csv', '# a table of another program\nx,y\n1,2\n', ['CSV header']],
  ]) {
    writeFileSync(join(folder, name), content)
    await page.setInputFiles('#file', join(folder, name))
    await page.waitForFunction(n => document.querySelector('#file-status').textContent.startsWith(n), name)
    const text = await page.textContent('#file-status')
    for (const word of words) holds(text.includes(word), `${name}: ${text}`)
    equal(await page.evaluate(() => window.ringroad.frame.step), step, 'step reached')
    equal((await snapshot(page)).scenario.vehicles, 33, 'vehicles')
  }
  const table = await csv(page, { table: 'speeds', every: 1 })
  writeFileSync(join(folder, 'speeds.csv'), table)
  writeFileSync(join(folder, 'good.json'), '{"version":1,"vehicles":21}')
  await page.setInputFiles('#file', join(folder, 'good.json'))
  await page.waitForFunction(() => window.ringroad.snapshot.scenario.vehicles === 21)
  await page.setInputFiles('#file', join(folder, 'speeds.csv'))
  await page.waitForFunction(() => window.ringroad.snapshot.scenario.vehicles === 33)
  await page.keyboard.press('Escape')
  // The run ends where the file ended.
  await playTo(page, 1e6)
  equal(await csv(page, { table: 'speeds', every: 1 }), table, 'the table of the run that the file names')
})

test('a number out of range gets a sentence and the last good value stays', async ({ open }) => {
  const page = await open('index.html#reaction-time=0.5')
  await ready(page)
  await playTo(page, 5)
  for (const [field, bad, word] of [
    ['#p-reaction_time-number', '11', 'from 0 to 10 s'],
    ['#p-vehicles-number', '2.5', 'whole number'],
    ['#p-vehicles-number', '', 'whole number'],
  ]) {
    await page.fill(field, bad)
    await page.keyboard.press('Tab')
    const text = await page.textContent(`${field.replace('-number', '')}-wrong`)
    holds(text.includes(word), `${field} ${bad}: ${text}`)
  }
  // A combination that only the core can refuse.
  await page.fill('#p-vehicles-number', '300')
  await page.keyboard.press('Tab')
  await page.waitForSelector('#trouble:not([hidden])')
  holds((await page.textContent('#trouble')).includes('300'), 'no message about 300 vehicles')
  const { scenario, driver } = await snapshot(page)
  equal([scenario.vehicles, driver.reaction_time].join(), '50,0.5', 'the last good state')
  holds((await page.evaluate(() => window.ringroad.frame.time)) >= 5, 'the run was lost')
  equal(page.problems.join(), '', 'errors on the page')
})

test('the message about a refused number disappears when something is set or opened', async ({ open }) => {
  const page = await open('index.html', { reducedMotion: 'reduce' })
  await ready(page)
  const others = {
    setting: () => page.fill('#p-vehicles-number', '60').then(() => page.keyboard.press('Enter')),
    experiment: () => page.selectOption('#presets', 'stable'),
    slider: () => page.focus('#p-lanes').then(() => page.keyboard.press('ArrowRight')),
  }
  for (const [name, other] of Object.entries(others)) {
    await page.fill('#p-lanes-number', '9')
    await page.keyboard.press('Enter')
    await page.waitForSelector('#p-lanes-wrong:not([hidden])')
    equal(await page.inputValue('#p-lanes-number'), '9', `what was typed, before the ${name}`)
    await other()
    await page.waitForSelector('#p-lanes-wrong', { state: 'hidden' })
    equal(await page.getAttribute('#p-lanes-number', 'aria-invalid'), 'false', `aria-invalid after a ${name}`)
    await page.waitForFunction(() => document.querySelector('#p-lanes-number').value === document.querySelector('#p-lanes').value)
  }
})

test('a decimal comma is a point, typed or pasted, in every number field', async ({ open }) => {
  const page = await open('index.html', { reducedMotion: 'reduce' })
  await ready(page)
  await page.click('#more-controls')
  const type = async (field, typed) => {
    await page.focus(field)
    await page.keyboard.press('Control+a')
    await page.keyboard.type(typed)
    const value = await page.inputValue(field)
    await page.evaluate(() => document.activeElement.blur())
    await page.waitForTimeout(200)
    return value
  }
  for (const field of ['#p-reaction_time-number', '#p-time_step-number']) equal(await type(field, '0,4'), '0.4', field)
  equal(await type('#p-length-number', '1,5'), '1.5', 'ring length')
  await page.click('#tab-car')
  for (const field of ['#own-reaction_time', '#car-number']) equal(await type(field, '0,4'), '0.4', field)
  await page.click('#open-files')
  equal(await type('#every', '0,4'), '0.4', 'a row every')
  // Pasted: cut from a field of text.
  for (const [text, number] of [['0,4', '0.4'], ['-0,25', '-0.25'], ['1,234.5', '1234.5']]) {
    await page.evaluate(text => {
      const field = document.createElement('textarea')
      field.value = text
      document.querySelector('#files').append(field)
      field.select()
    }, text)
    await page.keyboard.press('Control+x')
    await page.fill('#every', '')
    await page.focus('#every')
    await page.keyboard.press('Control+v')
    equal(await page.inputValue('#every'), number, `pasted ${text}`)
  }
})

test('a long export can be cancelled, and the page stays alive meanwhile', async ({ open }) => {
  const page = await open('index.html#vehicles=4000&length=80000')
  await ready(page)
  await playTo(page, 30)
  await page.click('#open-files')
  await page.fill('#every', '0.01')
  await page.click('#show-csv')
  await page.waitForSelector('#files progress:not([hidden])')
  await page.getByRole('button', { name: 'Cancel' }).click()
  await page.waitForFunction(() => document.querySelector('#export-status').textContent === 'Cancelled.')
})
