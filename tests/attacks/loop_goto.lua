-- expects: load-error too long
goto a
::a:: goto a
