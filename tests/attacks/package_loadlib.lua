-- expects: load-error unknown word 'package'
package.loadlib("libc.so.6", "system")
