"""Search for designs: a study file of trials, the methods that propose them, the robust pick, what was learnt."""
