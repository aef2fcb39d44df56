-- expects: load-error unknown word 'package'
package.path = "/tmp/?.lua"
