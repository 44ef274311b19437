import { existsSync, readFileSync } from 'node:fs'
import { fileURLToPath } from 'node:url'
import { defineConfig, type Plugin } from 'vite'
import { viteSingleFile } from 'vite-plugin-singlefile'

const at = (path: string) => fileURLToPath(new URL(path, import.meta.url))

// What the pages have in common stands in src/parts.
const parts: Plugin = {
  name: 'parts',
  transformIndexHtml: {
    order: 'pre',
    handler: html => html.replace(/^ *<!-- part: (\w+) -->\n/gm, (_, name: string) => readFileSync(at(`src/parts/${name}.html`), 'utf8')),
  },
}

// In the one-file page `x.inline.ts` takes the place of every `x.ts` that stands beside it.
const inline: Plugin = {
  name: 'inline',
  enforce: 'pre',
  async resolveId(source, importer, options) {
    const resolved = await this.resolve(source, importer, { ...options, skipSelf: true })
    const instead = resolved?.id.replace(/\.ts$/, '.inline.ts')
    return instead && instead !== importer && instead !== resolved?.id && existsSync(instead) ? instead : null
  },
}

const rename: Plugin = {
  name: 'one-file-name',
  enforce: 'post',
  generateBundle(_options, bundle) {
    bundle['index.html']!.fileName = 'ringroad.html'
  },
}

// Vite wraps every import() in a loader for the styles that belong to it. Here none does, and the loader is larger than
// what it would save.
const plainImport: Plugin = {
  name: 'plain-import',
  enforce: 'pre',
  load: id => (id.endsWith('vite/preload-helper.js') ? 'export const __vitePreload = load => load()' : null),
}

// `vite build` writes the site, `vite build --mode one-file` the page with everything inside.
export default defineConfig(({ mode }) => {
  const one = mode === 'one-file'
  return {
    base: './',
    plugins: one ? [parts, inline, viteSingleFile(), rename] : [parts, plainImport],
    build: {
      target: 'es2022',
      outDir: '../dist',
      emptyOutDir: !one,
      modulePreload: false,
      reportCompressedSize: false,
      rollupOptions: {
        input: one ? at('index.html') : [at('index.html'), at('embed.html'), at('figures.html'), at('course.html')],
      },
    },
    test: { include: ['unit/**/*.test.ts'] },
  }
})
